"""The systems, family by family."""

from . import frictions, linear, one_field, oscillators, random_matrices, rates, regimes, waves

FAMILIES = (oscillators, rates, frictions, linear, waves, one_field, random_matrices, regimes)
SYSTEMS = {system.name: system for family in FAMILIES for system in family.SYSTEMS}
