from .chain_wordings import (
    language_of as language_of,
)
from .conversion.convert_program import (
    Converted as Converted,
    convert_program as convert_program,
)
from .conversion.program_words import (
    words_of_control as words_of_control,
)
from .expansion_report import (
    Conversion as Conversion,
    ConversionError as ConversionError,
    Expansion as Expansion,
    ExpansionOptions as ExpansionOptions,
    Left as Left,
    NotConverted as NotConverted,
    Summary as Summary,
)
from .formulas.formula_request import (
    formulas_for as formulas_for,
    post_of_formulas as post_of_formulas,
)
from .moved import (
    MovedProgram as MovedProgram,
)
from .post_processors import (
    POSTS as POSTS,
    Arcs as Arcs,
    ArcsName as ArcsName,
    MachineKind as MachineKind,
    Numbering as Numbering,
    NumberingName as NumberingName,
    Post as Post,
    PostName as PostName,
    Risk as Risk,
    find_post as find_post,
    machine_of as machine_of,
    post_of as post_of,
)
from .rewrite import (
    Rewritten as Rewritten,
    Writer as Writer,
    rewrite as rewrite,
)
from .small_program import (
    ending_of as ending_of,
)
from .wordings import (
    NumberGround as NumberGround,
    WrittenBlock as WrittenBlock,
    WrittenWord as WrittenWord,
)
from .written import (
    WrittenContour as WrittenContour,
    WrittenContours as WrittenContours,
    write_contour as write_contour,
)
