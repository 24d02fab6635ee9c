"""A row of the table, and what is shared by the checks that make rows."""

from __future__ import annotations

from dataclasses import asdict, dataclass


@dataclass
class Row:
    system: str
    method: str
    check: str
    expected: str
    got: str
    verdict: str  # "right", "wrong", "refused": the method does not take the system, and says so
    case: str = ""  # of the worst run, where the verdict is wrong
    note: str = ""

    def public(self) -> dict:
        return asdict(self)


def row(system: str, method: str, check: str, expected: str, got: str, right: bool, case: str = "", note: str = "") -> Row:
    return Row(system, method, check, expected, got, "right" if right else "wrong", "" if right else case, note)
