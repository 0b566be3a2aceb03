"""The circumstances of blocks of a chain of which rules speak, by their names."""

NO_SENSE, NO_POLE, NO_BEFORE = "@no-sense", "@no-pole", "@no-before"
"""An arc without DR; polar data without a pole; a tangent element behind none."""
NO_BLOCK, TWO_BLOCKS, NO_LINE = "@no-block ", "@two-blocks ", "@no-line "
"""Before the name of a word that refers to a block: that block is not there; there are two; it is an arc, where the
word refers to a line."""
PARAMETER = "@parameter"
"""A word of it has a Q parameter for its number."""
NO_CENTER, NO_RADIUS = "@no-center", "@no-radius"
"""C without a CC in force; CR without R."""
NO_TURN = "@no-turn"
"""CT behind what is still to be found: to which side it turns is not known before."""
TURNS_BACK, CONTINUED, NEVER_CLOSED = "@turns-back", "@continued", "@never-closed"
"""An arc that goes back on the circle before it; a block that goes on in the next line; CLSD+ without CLSD-."""
CUT, TOOL, CLOSES_NOTHING = "@cut", "@tool-axis", "@closes-nothing"
"""A conventional move behind a chain that is still open; a tool axis that is not Z; CLSD- without CLSD+, or alone."""

FIRST_CORNER, LAST_CORNER, CORNERED, AT_ARC = "@first-corner", "@last-corner", "@cornered", "@at-arc"
"""A corner behind no element; an element with a corner, behind which none follows; an element beside a corner; an
element with a corner, of which that or the next one is an arc."""

APART = "@apart"
"""A corner beside an approach, a departure or a call."""

NO_COORDINATE = "@no-coordinate"
"""A pole without a coordinate."""

FULL = "@full-circle"
"""An arc about CC that ends where it begins."""
