"""YASNAC LX3: the rows that G111 and G112 share, about what stands beside the code in one block."""

from contoursolve.controls.yasnac_lx3.claim import OTHER_G
from contoursolve.diagnostics import Alarm, Source
from contoursolve.reading import Rule, some


def rows_of_block_alone(
    role: str, start: str, words: str, sources: tuple[Source, Source], own: tuple[Alarm, Alarm]
) -> tuple[Rule, Rule]:
    """The rows about what stands beside the code of a role and belongs into a block of its own: M, S and T words, and
    other G codes. `start` and such a block with its `words` are a right program; each row has its
    source and its alarm."""
    good = f"{start}{role} {words}"
    return (
        Rule(
            code=f"{role.lower()}-m-s-t",
            message=f"{{words:M S T}}: a {role} block takes no M, S or T word",
            help="write it in a block of its own",
            source=sources[0],
            alarm=own[0],
            roles=(role,),
            when=some("M", "S", "T"),
            accepted=(good + " F0.2", "M08\n" + good),
            rejected=(good + " M08", good + " S500", good + " T0101"),
        ),
        Rule(
            code=f"{role.lower()}-other-g",
            message=f"{{words:other G}} uses the axis words of the block itself, and so does {role}",
            help=f"write it in a block of its own; {role} needs no G01",
            source=sources[1],
            alarm=own[1],
            roles=(role,),
            when=some(OTHER_G),
            accepted=(good,),
            rejected=tuple(f"{start}{code} {role} {words}" for code in ("G01", "G04")),
        ),
    )
