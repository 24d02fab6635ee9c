"""The systems, family by family."""

from . import frictions, linear, one_field, oscillators, random_matrices, rates, waves

FAMILIES = (oscillators, rates, frictions, linear, waves, one_field, random_matrices)
SYSTEMS = {system.name: system for family in FAMILIES for system in family.SYSTEMS}
