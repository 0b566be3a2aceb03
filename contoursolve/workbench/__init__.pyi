from .command import serve as serve
from .desk import Desk as Desk
