#include <castor/castor.hpp>
#include <cup.hpp>

struct FindCup {
  std::string label;
};
CASTOR_REFLECT(FindCup, label)

class CupServer : public castor::ManagedComponent {
  void start() override {
    add(Cup{1, "mug"});
    on_call<FindCup>([this](const FindCup& request) {
      auto cups = read_where<Cup>(castor::field(&Cup::label) == request.label);
      if (cups.empty())
        throw std::runtime_error("there is no " + request.label);
      return *cups.front();
    });
  }
};
CASTOR_COMPONENT(CupServer, "finds cups for others")

class CupClient : public castor::UnmanagedComponent {
  void run() override {
    ask("mug");
    ask("bowl");
  }

  void ask(const std::string& label) {
    try {
      info("the {} is at {} m", label, call<FindCup, Cup>("vision", {label}).distance);
    } catch (const castor::CallException& e) {
      warning("{}", e.what());
    }
  }
};
CASTOR_COMPONENT(CupClient, "asks where cups are")
