"""Whole programs of one control, written for another one."""
