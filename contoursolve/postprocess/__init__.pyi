from .chain_wordings import (
    language_of as language_of,
)
from .expansion_report import (
    Conversion as Conversion,
    ConversionError as ConversionError,
    Expansion as Expansion,
    ExpansionOptions as ExpansionOptions,
    Left as Left,
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
    MachineKind as MachineKind,
    Numbering as Numbering,
    Post as Post,
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
