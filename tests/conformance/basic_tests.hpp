#pragma once

#include "castor/tests/conformance/tester.hpp"

#include <chrono>
#include <cstdint>
#include <memory>

/// The tests of BasicTester, and what it does of each.
namespace castor::conformance {

/// Reads back what it has added: by address, all of the type, and the newest four.
std::unique_ptr<Test> single_write(Tester& tester);

/// Adds an entry, and expects the next that another component adds at home to be its copy.
std::unique_ptr<Test> read_write(Tester& tester);

/// Adds a copy of what another component adds at home.
std::unique_ptr<Test> copy(Tester& tester);

/// Adds entries with the counts 0 to `entries` - 1.
std::unique_ptr<Test> write(Tester& tester, std::int64_t entries);

/// Expects the counts 0 to `entries` - 1 of everybody who adds an entry, anywhere and in this
/// order. Over when `authors` components have got there, or for 0, when nobody is on the way and
/// nothing happens for as long as `quiet`.
std::unique_ptr<Test> count(Tester& tester, std::int64_t entries, std::int64_t authors,
                            std::chrono::milliseconds quiet);

/// Overwrites its entry ten times, each time after reading it, so that none is refused unless
/// somebody else has written meanwhile. Begins when another component has overwritten the entry, or
/// after `pause`.
std::unique_ptr<Test> overwrite(Tester& tester, std::chrono::milliseconds pause);

/// The same without reading: what others have written must not get lost.
std::unique_ptr<Test> unsafe_overwrite(Tester& tester, std::chrono::milliseconds pause);

/// Overwrites what other components add at home; never ends.
std::unique_ptr<Test> replace(Tester& tester);

/// Deletes what other components write anywhere, if the count is a multiple of `divisor`; over when
/// it has deleted `wanted` entries, never for 0.
std::unique_ptr<Test> remove(Tester& tester, std::int64_t divisor, std::int64_t wanted);

/// Adds entries with rising counts, and whatever others delete of them once more under its old id.
/// Versions have to continue where they ended. Over after 100 of its own additions, if somebody has
/// deleted some.
std::unique_ptr<Test> readd(Tester& tester);

/// Registers twelve receivers whose filters all match one addition and which remove themselves when
/// they are called: each has to be called once, and none to be left.
std::unique_ptr<Test> receive(Tester& tester);

} // namespace castor::conformance
