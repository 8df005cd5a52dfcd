"""Rows and results to test with."""

from rows import Aim, Line, Point, Row, run


def row(labels=("one", "two"), lines=("Castor",), **more):
    arguments = {"name": "reads", "title": "Reads", "meaning": "As they are.", "unit": "reads/s", **more}
    return Row(lines=tuple(Line(x, tuple(Point(y, run("castor", y), "rate") for y in labels)) for x in lines),
               **arguments)


def results(rows, **more):
    return {"format": 1, "started": "2026-01-01 12:00", "rounds": 3, "seconds": 1.0,
            "machine": {"processor": "A <fast> one", "cores": 2, "memory": "8 GB", "virtual": True, "kernel": "6.1",
                        "system": "Debian", "castor": "abc"},
            "load": {"before": 0.01, "median": 0.02, "most": 0.3, "samples": []}, "warnings": [], "rows": rows, **more}


def at_least(value, label="one"):
    return Aim("at least", ("Castor", label), value)
