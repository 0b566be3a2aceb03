"""Where the facts about the control come from: its manual, and its alarms."""

from contoursolve.diagnostic import Alarm
from contoursolve.source import Evidence, Source

MANUAL = "YASNAC LX3 Instruction Manual"


def manual(place: str, evidence: Evidence = Evidence.PRINTED) -> Source:
    """A place in the manual."""
    return Source(MANUAL, place, evidence)


def alarms(evidence: Evidence) -> tuple[Alarm, Alarm, Alarm]:
    """The alarms of multiple cornering: words that do not belong into the block, a wrong combination of words,
    impossible geometry. They are printed for what Table 2.44 lists of G112 (p. 146), and assumed for all else."""
    return Alarm("144", evidence), Alarm("145", evidence), Alarm("146", evidence)
