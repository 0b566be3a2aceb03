from .exploration import (
    begin as begin,
)
from .explore import (
    explore as explore,
)
from .explorer import (
    Explorer as Explorer,
)
