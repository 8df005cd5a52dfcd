#pragma once

#include <memory>

namespace castor {

/// Has `wake(who)`, which wakes threads, called at the end of the calling thread's RingBatch, once
/// for each `who`; false if there is none. Does not allocate for one that is called already.
bool at_end_of_ring_batch(const std::shared_ptr<void>& who, void (*wake)(void* who));

} // namespace castor
