from .conversation import Conversation as Conversation
from .exercises import (
    Exercise as Exercise,
    OfferedAnswer as OfferedAnswer,
    exercise as exercise,
)
from .exploration import begin as begin
from .explore import explore as explore
from .mime_bundle import bundle as bundle, text_of as text_of
from .open_products import (
    Product as Product,
    converted as converted,
    expanded as expanded,
    expanded_beside_tool as expanded_beside_tool,
    notebook_about as notebook_about,
    page_about as page_about,
    project_settings as project_settings,
    report_on_tool as report_on_tool,
    stated_tool as stated_tool,
)
from .standing_alone import standing_alone as standing_alone
