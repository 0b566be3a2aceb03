"""What becomes of a contour with open choices, further facts, or values that are asked for."""

from contoursolve.settling.partly import said_twice
from contoursolve.settling.settlement import Settlement, orders_of, settle, settled_by
from contoursolve.settling.tied import tied_with

__all__ = ["Settlement", "orders_of", "said_twice", "settle", "settled_by", "tied_with"]
