"""What changes cost in messages, counted from who wants them and where everybody is. Pure.

A layout is a list of subarchitectures, each a list of components; `hears` has for each component those whose changes
it wants. All components make equally many changes. Counts are for each change:

    messages    events from working memory to working memory
    deliveries  events from working memory to component
    wasted      of these, those that the component does not want, and has to filter out

after the three schemes of the paper's section 4.2.3 and of Castor.
"""

from dataclasses import dataclass
from random import Random


@dataclass(frozen=True)
class Counts:
    messages: float
    deliveries: float
    wasted: float


BROADCAST, FORWARDED, FILTERED = "broadcast", "filtered between", "filtered between and within"
SCHEMES = {
    BROADCAST: "each change to each working memory, and there to each component, which filters for itself",
    FORWARDED: "each change to each working memory that has a component that wants it, and there to each component",
    FILTERED: "each change to each working memory that has a component that wants it, and to that component alone",
}


def counts(layout, hears, scheme):
    components = [x for place in layout for x in place]
    home = {x: i for i, place in enumerate(layout) for x in place}
    messages = deliveries = wanted = 0
    for source in components:
        receivers = [x for x in components if source in hears[x]]
        places = {home[x] for x in receivers}
        wanted += len(receivers)
        if scheme == BROADCAST:
            messages += len(layout) - 1
            deliveries += len(components)
        else:
            messages += len(places - {home[source]})
            # Within the subarchitecture of the change, working memories tell all components of it.
            told = sum(len(layout[i]) for i in places | {home[source]})
            deliveries += told if scheme == FORWARDED else len(receivers)
    count = len(components)
    return Counts(messages / count, deliveries / count, (deliveries - wanted) / count)


def modules(count, size):
    """Components c0 and up, in modules of a size: those that are made to work together."""
    names = [f"c{i}" for i in range(count)]
    return [names[i:i + size] for i in range(0, count, size)]


def interests(groups, wanted, across, seed=1):
    """Each component hears `wanted` others: a share `across` of them, rounded, in other modules than its own."""
    random = Random(seed)
    result = {}
    for i, group in enumerate(groups):
        others = [x for j, other in enumerate(groups) if j != i for x in other]
        for component in group:
            far = round(wanted * across)
            near = [x for x in group if x != component]
            result[component] = sorted(random.sample(near, wanted - far) + random.sample(others, far))
    return result


def layouts(groups):
    """The same components in one subarchitecture, in one for each module, and each in one of its own."""
    components = [x for group in groups for x in group]
    return {"1": [components], "m": groups, "n": [[x] for x in components]}


def cast_text(layout, hears, groups, changes, pause, nodes=0):
    """The .cast file. With nodes, modules are spread over them, and each subarchitecture is with its first component."""
    host = {x: f"node{i % nodes}" if nodes else "localhost" for i, group in enumerate(groups) for x in group}
    lines = []
    for i, place in enumerate(layout):
        lines += [f"SUBARCHITECTURE s{i} {host[place[0]]}", "CPP WM SubarchitectureWorkingMemory",
                  "CPP TM AlwaysPositiveTaskManager"]
        for x in place:
            where = f"[{host[x]}] " if nodes else ""
            wants = f" --hears {','.join(hears[x])}" if hears[x] else ""
            lines.append(f"{where}CPP UM {x} Talker{wants} --changes {changes} --pause {pause}")
    return "\n".join(lines) + "\n"
