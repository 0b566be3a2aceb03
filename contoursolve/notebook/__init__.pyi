from .explore import explore as explore
from .mime_bundle import bundle as bundle
