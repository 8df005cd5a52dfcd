"""Simulation of a system of many nodes: what is to be done by which processor, in which order, with the costs that
were measured. Pure.

Each process runs on a machine of its own, or all share some processors, as in the systems that are measured. Messages
take LATENCY from one machine to another.
"""

import heapq
import itertools
import random
from dataclasses import dataclass

LATENCY = 100e-6
# Of a start: configure, start and run, each of which every node answers.
PHASES = 3
# A node is out of reach after so long without a sign of life; on a resting link to the coordinator that comes every
# third of it.
SILENCE = 1.0
HEARTBEAT = SILENCE / 3
# How often the coordinator looks.
GLANCE = 0.1


@dataclass(frozen=True)
class Costs:
    """Seconds of processor time in a system of some size."""

    start_coordinator: float
    start_node: float
    hearing_coordinator: float
    hearing_node: float
    idle_coordinator: float = 0.0


class Simulation:
    """Processors that do one thing after the other, and events in time. The coordinator is process 0."""

    def __init__(self, nodes, shared=0):
        self.nodes = nodes
        self.shared = shared
        # When each processor is free: one for each process, or those that all share.
        self.free = [0.0] * (shared or nodes + 1)
        self.events = []
        self.numbers = itertools.count()
        self.now = 0.0

    def at(self, time, work):
        heapq.heappush(self.events, (time, next(self.numbers), work))

    def compute(self, process, cost, then):
        """Process `process` computes for `cost` seconds when its processor is free; calls `then` afterwards."""
        processor = min(range(self.shared), key=self.free.__getitem__) if self.shared else process
        end = max(self.now, self.free[processor]) + cost
        self.free[processor] = end
        self.at(end, then)

    def send(self, then):
        self.at(self.now + (0.0 if self.shared else LATENCY), then)

    def run(self, until=lambda: False):
        """The time of the last event, or of that after which `until` is true."""
        while self.events and not until():
            self.now, _, work = heapq.heappop(self.events)
            work()
        return self.now


def time_to_start(nodes, costs, shared=0):
    """Seconds until all run: the coordinator reaches each node, which then connects with the others, and leads all of
    them through the phases."""
    simulation = Simulation(nodes, shared)
    # Of the steps, connecting with the coordinator and the others, and the phases, each is taken to cost the same.
    coordinator = costs.start_coordinator / (nodes * (1 + PHASES))
    joining = costs.start_node / 2
    phase = costs.start_node / 2 / PHASES
    waiting = [nodes]

    def next_phase(number):
        if number > PHASES:
            return
        waiting[0] = nodes
        for node in range(1, nodes + 1):
            simulation.compute(0, coordinator, lambda node=node: simulation.send(
                lambda: simulation.compute(node, phase, lambda: simulation.send(lambda: answered(number)))))

    def answered(number):
        waiting[0] -= 1
        if waiting[0] == 0:
            next_phase(number + 1)

    for node in range(1, nodes + 1):
        simulation.compute(0, coordinator, lambda node=node: simulation.send(
            lambda: simulation.compute(node, joining, lambda: simulation.send(lambda: answered(0)))))
    return simulation.run()


def time_to_hear(nodes, costs, shared=0):
    """Seconds until a component on each node has heard of a change at the coordinator."""
    simulation = Simulation(nodes, shared)
    for node in range(1, nodes + 1):
        simulation.compute(0, costs.hearing_coordinator, lambda node=node: simulation.send(
            lambda: simulation.compute(node, costs.hearing_node, lambda: None)))
    return simulation.run()


def time_to_notice(nodes, costs, seed=1):
    """Seconds from when a node becomes silent until the coordinator finds it out of reach, while it handles the
    heartbeats of all; and how many others it finds out of reach by mistake, because it is late itself."""
    simulation = Simulation(nodes)
    generator = random.Random(seed)
    heartbeat_cost = costs.idle_coordinator * HEARTBEAT / nodes
    # Long enough for what the coordinator is behind with to show.
    silent_from, most = 5.0, 20.0
    heard = [0.0] * (nodes + 1)
    noticed = {}

    def heartbeat(node):
        if node == 1 and simulation.now >= silent_from:
            return
        simulation.send(lambda: simulation.compute(0, heartbeat_cost, lambda: hear(node)))
        simulation.at(simulation.now + HEARTBEAT, lambda: heartbeat(node))

    def hear(node):
        heard[node] = simulation.now

    def look():
        for node in range(1, nodes + 1):
            if simulation.now - heard[node] > SILENCE:
                noticed.setdefault(node, simulation.now)
        simulation.at(simulation.now + GLANCE, lambda: simulation.compute(0, 0.0, look))

    for node in range(1, nodes + 1):
        simulation.at(generator.random() * HEARTBEAT, lambda node=node: heartbeat(node))
    simulation.at(GLANCE, look)
    simulation.run(until=lambda: noticed.get(1, -1.0) >= silent_from or simulation.now > most)
    mistakes = sum(1 for node in noticed if node != 1)
    return noticed.get(1, most) - silent_from, mistakes
