"""Programs as a control runs them: variables, jumps, loops, subprograms and the profiles of cycles."""
