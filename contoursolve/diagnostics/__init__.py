"""Findings, the places they are about, and where a fact comes from.

Nothing comes in but text and numbers; records go out that every other room uses. Begin with `finding`.
"""
