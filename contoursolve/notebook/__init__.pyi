from . import mime_bundle as mime_bundle
from .conversation import Conversation as Conversation
from .exploration import begin as begin
from .explore import explore as explore, explore_map as explore_map
from .standing_alone import standing_alone as standing_alone
