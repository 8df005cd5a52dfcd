"""What scripts/bench measures: rows of figures, each of Castor and of its peers, and what is aimed at."""

from dataclasses import dataclass

CASTOR, BARE, REDIS, DDS, SQLITE = "Castor", "bare CAF", "Redis", "Cyclone DDS", "SQLite"


@dataclass(frozen=True)
class Run:
    """One start of a program, which measures several figures. `arguments` are pairs of name and value."""

    program: str
    measurement: str
    arguments: tuple = ()
    # Seconds that it takes at least, however few the options give: what goes on now and then takes time to be seen.
    least_seconds: float = 0.0

    def __str__(self):
        return " ".join([self.program, self.measurement] + [f"{name}={value}" for name, value in self.arguments])


@dataclass(frozen=True)
class Point:
    """A figure of a run, in the row's unit after multiplication by the factor."""

    label: str
    run: Run
    figure: str = "rate"
    factor: float = 1.0


@dataclass(frozen=True)
class Line:
    """Figures that belong together: those of a contender."""

    name: str
    points: tuple
    # Whose absence leaves the line out.
    peer: str = CASTOR


@dataclass(frozen=True)
class Aim:
    """A figure that is aimed at. `point` is (line, label).

    at least, at most: a value
    at least that of:  the point (line, label) of another contender
    at most that of:   the other point, beyond `value` as a share of it
    does not fall:     no figure of the line is below its first one, beyond `value` as a share of it
    """

    kind: str
    point: tuple
    value: float = 0.0
    other: tuple = ()


@dataclass(frozen=True)
class Row:
    name: str
    title: str
    meaning: str
    unit: str
    lines: tuple
    higher_is_better: bool = True
    aims: tuple = ()
    # Takes long, or hardly varies: fewer rounds do.
    slow: bool = False


def run(program, measurement, least_seconds=0.0, **arguments):
    return Run(program, measurement, tuple(arguments.items()), least_seconds)


def _castor(measurement, least_seconds=0.0, **arguments):
    return run("castor", measurement, least_seconds, **arguments)


def _line(name, points):
    return Line(name, tuple(points), name if name in (BARE, REDIS, DDS, SQLITE) else CASTOR)


COMPONENTS = (1, 2, 4, 8, 16)
LISTENERS = (1, 4, 16, 64)
# Those that are CallbackComponents.
POOLED = ", without threads"
NODES = (2, 5, 10, 20, 30, 100)
IDLE_COMPONENTS = (1000, 3000)
IDLE_SECONDS = 4
# Ends of links where nothing is awaited say every 20 s that they are there, which is most of what many nodes do.
IDLE_SECONDS_OF_MANY = 20
ENTRY_OPERATIONS = ("add", "read", "delete")
ENTRIES = ((100_000, "100 k entries"), (1_000_000, "1 M entries"))
KB, MB = 1024, 1024 * 1024


def _counted(count, noun):
    return f"{count:,} {noun}" + ("" if count == 1 else "s")


def _local_rows():
    operations = _castor("operations", bytes=100)
    yield Row(
        "readers", "Reads, as readers are added",
        "Components that read entries of 100 B of one working memory in their process, all together.", "reads/s",
        (_line(CASTOR, [Point(_counted(n, "reader"), _castor("readers", components=n, bytes=100))
                        for n in COMPONENTS]),),
        aims=(Aim("does not fall", (CASTOR, ""), 0.05),))
    yield Row(
        "writers", "Overwrites, as writers are added",
        "Components that each overwrite an entry of 100 B of one working memory in their process, one at a time, "
        "all together.", "overwrites/s",
        (_line(CASTOR, [Point(_counted(n, "writer"), _castor("writers", components=n, bytes=100, in_flight=1))
                        for n in COMPONENTS]),),
        aims=(Aim("does not fall", (CASTOR, ""), 0.05),))
    yield Row(
        "operations", "Operations of one component",
        "Operations on entries of 100 B in the same process, each of which has taken effect when it returns; and "
        "overwrites with 64 under way. Bare CAF: a blocking request to an actor with the same payload.", "per second",
        (_line(CASTOR, [Point("read", operations, "read"), Point("overwrite", operations, "overwrite"),
                        Point("64 overwrites in flight", _castor("writers", components=1, bytes=100, in_flight=64)),
                        Point("add", operations, "add"), Point("delete", operations, "delete"),
                        Point("lock and unlock", operations, "lock")]),
         _line(BARE, [Point("overwrite", run("bare", "writes", bytes=100, in_flight=1)),
                      Point("64 overwrites in flight", run("bare", "writes", bytes=100, in_flight=64))])),
        aims=(Aim("at least", (CASTOR, "read"), 5e6), Aim("at least", (CASTOR, "overwrite"), 1e6)))
    yield Row(
        "contended-lock", "One lock that four components want",
        "Pairs of lock and unlock of the same entry by four components, all together. The original CAST does 177,000.",
        "pairs/s", (_line(CASTOR, [Point("4 components", _castor("contended_lock", components=4))]),),
        aims=(Aim("at least", (CASTOR, "4 components"), 177e3),))
    events = _castor("events", bytes=100)
    yield Row(
        "events", "From an overwrite to a callback",
        "Time from the call of overwrite to the callback of another component of the process, which was asleep.", "us",
        (_line(CASTOR, [Point("median", events, "p50"), Point("99 %", events, "p99")]),), higher_is_better=False)
    yield Row(
        "fan-out", "Many listeners",
        "One component overwrites without a pause; every overwrite is told to all listeners, components of the same "
        "process.", "per second",
        tuple(_line(figure + of, [Point(_counted(n, "listener"), _castor(
            "fan_out", listeners=n, bytes=100, **{"class": name}), figure) for n in LISTENERS])
              for of, name in (("", "Counter"), (POOLED, "PooledCounter")) for figure in ("callbacks", "overwrites")),
        aims=(Aim("at least", ("callbacks", "64 listeners"), 1e6), Aim("at least", ("callbacks" + POOLED, "64 listeners"), 1e6),
              Aim("at least that of", ("callbacks" + POOLED, "64 listeners"), other=("callbacks", "64 listeners"))))


def _link_writes(size, in_flight, label, factor=1.0):
    """Of every contender, the point with the writes of that size."""

    def point(program, **more):
        arguments = {"bytes": size, "in_flight": in_flight, **more}
        return Point(label, run(program, "link_writes", **arguments), factor=factor)

    redis_depth = min(in_flight, 16)
    return {CASTOR: point("castor"), BARE: point("bare"),
            REDIS: point("redis", in_flight=redis_depth, clients=1), DDS: point("dds")}


def _contenders(*points):
    return tuple(_line(name, [x[name] for x in points]) for name in (CASTOR, BARE, REDIS, DDS))


def _link_rows():
    yield Row(
        "link-writes", "Overwrites in another process, one at a time",
        "100 B, on the loopback device, each acknowledged before the next: overwrites of an entry, requests to an "
        "actor, SETs, and samples that the other process acknowledges with a sample.", "overwrites/s",
        _contenders(_link_writes(100, 1, "100 B")),
        aims=tuple(Aim("at least that of", (CASTOR, "100 B"), other=(peer, "100 B")) for peer in (BARE, REDIS)))
    yield Row(
        "link-pipelined", "Overwrites in another process, many in flight",
        "100 B, with 64 of them not yet acknowledged; Redis: pipelines of 16 SETs.", "overwrites/s",
        _contenders(_link_writes(100, 64, "100 B, 64 in flight")),
        aims=(Aim("at least that of", (CASTOR, "100 B, 64 in flight"), other=(REDIS, "100 B, 64 in flight")),))
    yield Row(
        "link-large", "Large values to another process",
        "The same with 64 KB and 1 MB; what they amount to.", "GB/s",
        _contenders(_link_writes(64 * KB, 64, "64 KB, 64 in flight", 64 * KB / 1e9),
                    _link_writes(MB, 64, "1 MB, 64 in flight", MB / 1e9)),
        aims=(Aim("at least that of", (CASTOR, "64 KB, 64 in flight"), other=(REDIS, "64 KB, 64 in flight")),
              Aim("at least", (CASTOR, "1 MB, 64 in flight"), 2.0)))
    events = [(name, run(program, "link_events", bytes=100))
              for name, program in ((CASTOR, "castor"), (REDIS, "redis"), (DDS, "dds"))]
    yield Row(
        "link-events", "From an overwrite to a callback in another process",
        "Time from the call of overwrite to the callback of a component in another process, which was asleep. Redis: "
        "SET and PUBLISH to a subscriber; DDS: a write to a reader.", "us",
        tuple(_line(name, [Point("median", x, "p50"), Point("99 %", x, "p99")]) for name, x in events),
        higher_is_better=False, aims=(Aim("at most", (CASTOR, "median"), 40.0),))
    yield Row(
        "link-readers", "Several readers of one value in another process",
        "Components of one process read an entry of 64 KB in another one each time that it was overwritten from here: "
        "bytes that come over the link for each of them.", "KB/reader",
        (_line(CASTOR, [
            Point(_counted(n, "reader"), _castor("link_readers", readers=n, bytes=64 * KB), "bytes", 1 / KB)
            for n in (1, 2, 4, 8)]),), higher_is_better=False,
        # Once for each version, whoever reads it.
        aims=(Aim("at most", (CASTOR, "8 readers"), 64 / 8 * 1.05),))


def _idle_rows():
    mesh = [(_counted(n, "node"), _castor("idle_mesh", IDLE_SECONDS_OF_MANY if n > 20 else IDLE_SECONDS, nodes=n))
            for n in NODES]
    yield Row(
        "idle-mesh-cpu", "A mesh in which nothing happens: processor",
        "Nodes, each a process with a working memory and a component, and their coordinator; all together.",
        "% of a core", (_line(CASTOR, [Point(label, x, "cpu") for label, x in mesh]),), higher_is_better=False,
        slow=True, aims=(Aim("at most", (CASTOR, "100 nodes"), 5.0),))
    yield Row(
        "idle-mesh-memory", "A mesh in which nothing happens: memory",
        "Of each node: its own memory, and its share of what it has in common with others (PSS), the coordinator's "
        "included.", "MB/node", (_line(CASTOR, [Point(label, x, "memory", 1 / MB) for label, x in mesh]),),
        higher_is_better=False, slow=True)
    idle = {title: [(_counted(n, "component"), _castor("idle_components", IDLE_SECONDS, components=n, **{"class": name}))
                    for n in counts]
            for title, name, counts in ((CASTOR, "Idler", IDLE_COMPONENTS),
                                        (CASTOR + POOLED, "PooledIdler", IDLE_COMPONENTS + (10_000,)))}
    rests = (Aim("at most", (CASTOR, _counted(IDLE_COMPONENTS[-1], "component")), 0.1),
             Aim("at most", (CASTOR + POOLED, "10,000 components"), 0.1))
    for figure, title, unit, factor, aims in (
            ("cpu", "processor", "% of a core", 1, rests), ("start", "time to start", "s", 1, ()),
            ("memory", "memory", "KB/component", 1 / KB, ())):
        yield Row(
            "idle-components-" + figure, "Components for which there is nothing to do: " + title,
            "Components of one process, each with a filter, and with a thread of its own or, as CallbackComponents, none.",
            unit, tuple(_line(title, [Point(label, x, figure, factor) for label, x in points])
                        for title, points in idle.items()), higher_is_better=False, slow=True, aims=aims)


def _entry_rows():
    runs = [(label, _castor("entries", entries=n)) for n, label in ENTRIES]
    yield Row(
        "entry-memory", "Memory of an entry",
        "Memory that entries of 100 B take, and what the process keeps of that after their deletion, for each of them.",
        "B/entry", tuple(_line(name, [Point(label, x, figure) for label, x in runs])
                         for name, figure in (("while they exist", "bytes"), ("after their deletion", "left"))),
        higher_is_better=False, slow=True,
        # What is left is to be less than a tenth of what they took.
        aims=tuple(Aim("at most", (line, label), value) for line, value in (("while they exist", 300),
                                                                            ("after their deletion", 45))
                   for _, label in ENTRIES))
    yield Row(
        "entry-rates", "Operations among many entries",
        "Each of so many entries of 100 B is added, then read, then deleted, by one component.", "per second",
        tuple(_line(name, [Point(label, x, name) for label, x in runs]) for name in ENTRY_OPERATIONS),
        slow=True, aims=tuple(Aim("does not fall", (name, ""), 0.05) for name in ENTRY_OPERATIONS))


def _journal_row():
    def point(program, clients, in_flight, measurement="durable_writes", **more):
        label = f"{_counted(clients, 'writer')} x {in_flight} in flight"
        return Point(label, run(program, measurement, bytes=100, clients=clients, in_flight=in_flight, **more))

    cases = ((1, 1), (16, 1), (4, 64))
    return Row(
        "durable-writes", "Durable writes",
        "Acknowledged once they are on the disk, 100 B: overwrites with the journal mode full, SETs with "
        "appendfsync always, and rows in transactions of as many as are in flight together.", "writes/s",
        (_line(CASTOR, [point("castor", *x) for x in cases]),
         _line(REDIS, [point("redis", *x, measurement="link_writes", durable=1) for x in cases]),
         _line(SQLITE, [point("sqlite", *x) for x in cases])),
        aims=tuple(Aim("at least that of", (CASTOR, point("castor", *x).label), other=(REDIS, point("redis", *x).label))
                   for x in cases))


def _vision_rows():
    yield Row(
        "vision-start", "Start of vision",
        "From the start of `castor run configs/vision.cast` until its first picture is processed.", "s",
        (_line(CASTOR, [Point("vision.cast", run("castor run", "vision"), "seconds")]),), higher_is_better=False,
        slow=True, aims=(Aim("at most", (CASTOR, "vision.cast"), 0.08),))
    picture = run("vision", "first_picture")
    yield Row(
        "first-picture", "The first picture that vision segments",
        "A rendered picture of 640 x 480 with a ball and a cube, after what a segmentor does when it is configured; and the "
        "same again, the median.", "ms",
        (_line(CASTOR, [Point("first", picture, "first"), Point("later", picture, "later")]),), higher_is_better=False,
        aims=(Aim("at most that of", (CASTOR, "first"), 0.1, (CASTOR, "later")),))


ROWS = (*_local_rows(), *_link_rows(), *_idle_rows(), *_entry_rows(), _journal_row(), *_vision_rows())
