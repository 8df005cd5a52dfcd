// Components that are written to and called from outside.
#include "castor/actors/component/registry.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

enum class Portion { small, large };
CASTOR_REFLECT_ENUM(Portion, small, large)

struct Place {
  int table = 0;
  int seat = 0;
};
CASTOR_REFLECT(Place, table, seat)

struct Order {
  std::string dish;
  Portion portion = Portion::small;
  Place place;
  std::vector<std::string> extras;
  std::optional<std::string> note;
};
CASTOR_REFLECT(Order, dish, portion, place, extras, note)

/// Nobody writes one.
struct Receipt {
  double total = 0;
};
CASTOR_REFLECT(Receipt, total)

struct Boil {
  double litres = 0;
};
CASTOR_REFLECT(Boil, litres)

struct Boiled {
  double litres = 0;
  std::string by;
};
CASTOR_REFLECT(Boiled, litres, by)

struct Voucher {
  int meals = 0;
};
CASTOR_REFLECT(Voucher, meals)

/// Is in no system.
class Cashier final : public UnmanagedComponent {
  void start() override {
    on_change(added<Voucher>(), [this](const ChangeEvent&) { info("takes it"); });
  }
};
CASTOR_COMPONENT(Cashier, "takes vouchers")

/// Hears of orders, boils water.
class Cook final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Order>(), [this](const ChangeEvent& event) {
      info("{} of {} by {}", to_string(event.operation), event.address.id, event.source);
    });
    on_call<Boil>([this](const Boil& request) {
      if (request.litres <= 0)
        throw std::runtime_error("there is nothing to boil");
      while (request.litres > 100 && is_running() && !call_cancelled())
        sleep_for(10ms);
      return Boiled{request.litres, "cook"};
    });
    on_change(added<Receipt>(), [this](const ChangeEvent&) { info("is paid"); });
    info("cooks");
  }
};
CASTOR_COMPONENT(Cook, "hears of orders and boils water")

struct Heat {
  int degrees = 0;
};
CASTOR_REFLECT(Heat, degrees)

/// Obeys who holds the lease of an order.
class Stove final : public StandaloneComponent {
  void start() override {
    on_command<Heat>([this](const Heat& x) { set(x.degrees); }, [this] { set(0); },
                     {150ms, Address{"kitchen", "guarded"}});
  }

  void set(int degrees) { info("has {} degrees", degrees); }
};
CASTOR_COMPONENT(Stove, "is commanded")

/// Keeps an order locked.
class Guard final : public UnmanagedComponent {
  void run() override {
    add(here("guarded"), Order{});
    auto guard = lock(here("guarded"), LockLevel::od);
    info("guards");
    while (is_running())
      sleep_for(10ms);
  }
};
CASTOR_COMPONENT(Guard, "holds a lease of an entry")

} // namespace

} // namespace castor::test
