from .ball import (
    Number as Number,
)
from .charts import (
    Bounds as Bounds,
    Chart as Chart,
    Following as Following,
)
from .columns import (
    ROWS as ROWS,
    ColumnFunction as ColumnFunction,
    Columns as Columns,
    compile_columns as compile_columns,
    difference as difference,
    directions as directions,
    replay_rows as replay_rows,
)
from .echelon import (
    CONSTANT as CONSTANT,
    Echelon as Echelon,
)
from .expressions import (
    Compiled as Compiled,
    Expression as Expression,
    Tape as Tape,
    affine_parts as affine_parts,
    angle as angle,
    at_most as at_most,
    below as below,
    cosine as cosine,
    inverse_norm as inverse_norm,
    inverse_norms as inverse_norms,
    is_affine as is_affine,
    is_number as is_number,
    is_zero as is_zero,
    jacobian_parts as jacobian_parts,
    larger as larger,
    largest as largest,
    magnitude as magnitude,
    quadratic_parts as quadratic_parts,
    sign as sign,
    sine as sine,
    sqrt as sqrt,
    symbol as symbol,
    true as true,
    where as where,
)
from .formulas import (
    AT_MOST as AT_MOST,
    COMMON as COMMON,
    LESS as LESS,
    SIGN as SIGN,
    TURNED as TURNED,
    ZERO as ZERO,
    formulas_of as formulas_of,
)
from .functions import FLOATS as FLOATS, Created as Created, Functions as Functions, trimmed as trimmed
from .given_angle import (
    COSINE as COSINE,
    SIDE as SIDE,
    SINE as SINE,
    direction as direction,
)
from .hc4 import (
    Boxes as Boxes,
    Narrower as Narrower,
    approach as approach,
    contract as contract,
    joined as joined,
    stacked as stacked,
)
from .interpreter import (
    Replay as Replay,
)
from .intervals import (
    Intervals as Intervals,
    constant as constant,
)
from .linear_algebra import (
    Array as Array,
    condition as condition,
    pinv as pinv,
    svd as svd,
)
from .modular_rank import (
    PRIME as PRIME,
    RESIDUES as RESIDUES,
    ExactRank as ExactRank,
    Residue as Residue,
    Row as Row,
    draw as draw,
    draw_direction as draw_direction,
)
from .named_function import (
    closed_function as closed_function,
    implicit_function as implicit_function,
    put_in as put_in,
)
from .newton import (
    Finder as Finder,
    finder_of as finder_of,
)
from .sections import (
    SECTIONS as SECTIONS,
    halve as halve,
    section as section,
)
from .terms import (
    Affine as Affine,
    Apply as Apply,
    Constant as Constant,
    Indexed as Indexed,
    Quoted as Quoted,
    Term as Term,
    Variable as Variable,
)
