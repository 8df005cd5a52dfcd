#include "castor/tests/conformance/basic_tests.hpp"

#include "castor/actors/component/registry.hpp"

#include <string>

namespace castor::conformance {

namespace {

class BasicTester final : public Tester {
public:
  BasicTester() {
    offer("single-write", [this] { return single_write(*this); });
    offer("read-write", [this] { return read_write(*this); });
    offer("copy", [this] { return conformance::copy(*this); });
    for (std::int64_t n : {10, 100, 1000}) {
      offer("write-" + std::to_string(n), [this, n] { return conformance::write(*this, n); });
      offer("count-" + std::to_string(n),
            [this, n] { return conformance::count(*this, n, authors_, quiet_); });
    }
    offer("overwrite", [this] { return conformance::overwrite(*this, pause_); });
    offer("unsafe-overwrite", [this] { return unsafe_overwrite(*this, pause_); });
    offer("replace", [this] { return replace(*this); });
    offer("delete", [this] { return conformance::remove(*this, 1, count_); });
    offer("delete-5", [this] { return conformance::remove(*this, 5, count_); });
    offer("readd", [this] { return readd(*this); });
    offer("receive", [this] { return receive(*this); });
  }

private:
  Option<std::int64_t> authors_{this, "authors", 0,
                                "count: how many components are to be counted; 0: unknown"};
  Option<std::chrono::milliseconds> quiet_{
    this, "quiet", std::chrono::milliseconds{500},
    "count: without --authors, for how long nothing has to happen at the end"};
  Option<std::chrono::milliseconds> pause_{
    this, "pause", std::chrono::milliseconds{200},
    "overwrite: how long to wait for another component to overwrite the entry first"};
  Option<std::int64_t> count_{this, "count", 0,
                              "delete: after how many the test has passed; 0: it never ends"};
};
CASTOR_COMPONENT(BasicTester, "tests reading, writing, deleting, versions, and change filters")

} // namespace

} // namespace castor::conformance
