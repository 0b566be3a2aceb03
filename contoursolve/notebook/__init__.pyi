from . import bundle as bundle
from .explore import explore as explore
