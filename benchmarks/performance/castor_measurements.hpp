#pragma once

#include "castor/benchmarks/performance/measurement.hpp"

namespace castor::benchmark {

// -- within one process

/// `components` that read: figure `rate`.
void measure_readers(const Arguments& x);
/// `components` that overwrite, each an entry of its own, with `in_flight` writes under way: figure
/// `rate`.
void measure_writers(const Arguments& x);
/// One component: figures `read`, `overwrite`, `add`, `delete` and `lock`.
void measure_operations(const Arguments& x);
/// `components` that lock and unlock one entry: figure `rate`.
void measure_contended_lock(const Arguments& x);
/// From an overwrite to the callback of another component: figures `p50` and `p99`.
void measure_events(const Arguments& x);
/// `listeners` of a `class`, Counter or PooledCounter, to each of many overwrites: figures `overwrites` and `callbacks`.
void measure_fan_out(const Arguments& x);
/// `entries` of 100 B: figures `add`, `read`, `delete`, `bytes` (of each entry) and `left` (after
/// deletion, of each entry).
void measure_entries(const Arguments& x);

// -- over a link to another process

/// Overwrites of an entry there, with `in_flight` under way: figure `rate`.
void measure_link_writes(const Arguments& x);
/// From an overwrite here to the callback of a component there: figures `p50` and `p99`.
void measure_link_events(const Arguments& x);
/// Readers here of one entry there, which is overwritten in between: figures `bytes` over the link
/// for each overwrite and reader, and `rate` of reads.
void measure_link_readers(const Arguments& x);

// -- with a journal

/// Overwrites in the mode `full`, by `clients` with `in_flight` under way each, with the journal in
/// `folder`: figure `rate`.
void measure_durable_writes(const Arguments& x);

// -- systems of many nodes, or many components

/// A mesh of `nodes`, each with a component: figures `cpu` (percent of a core, all processes) and
/// `memory` (bytes for each node).
void measure_idle_mesh(const Arguments& x);
/// A system with so many `nodes`: figures `start` (seconds), and, each followed by `_coordinator` or
/// `_node`, what it takes of one process: `start` (seconds of processor time), `idle` (seconds for
/// each second), `memory` (bytes) and `hearing` (seconds for each event and node); `p50` and `p99`
/// (microseconds until all nodes have heard of an overwrite); `silent` and `killed` (seconds until
/// a node that is stopped, or killed, is out of reach).
void measure_mesh(const Arguments& x);
/// One process with so many `components` of a `class`, Idler or PooledIdler: figures `cpu` (percent
/// of a core), `memory` (bytes for each component) and `start` (seconds).
void measure_idle_components(const Arguments& x);

} // namespace castor::benchmark
