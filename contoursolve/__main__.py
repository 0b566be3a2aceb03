"""`python -m contoursolve` is the command `contoursolve`."""

from contoursolve.cli import main

if __name__ == "__main__":
    main(prog_name="contoursolve")
