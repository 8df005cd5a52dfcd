#include <castor/castor.hpp>
#include <cup.hpp>

#include <fstream>

class Logbook : public castor::UnmanagedComponent {
  castor::Option<std::string> file_{this, "file", "cups.csv", "where the lines go"};
  castor::Option<double> farthest_{this, "farthest", 2,
                                   "cups farther than this are left out, metres"};
  std::ofstream lines_;

  void configure() override {
    if (farthest_ <= 0)
      throw std::invalid_argument("--farthest has to be more than 0");
    lines_.open(file_.get());
    if (!lines_)
      throw std::runtime_error("cannot write " + file_.get());
  }

  void start() override {
    on_change(castor::added<Cup>().anywhere(), [this](const castor::ChangeEvent& event) {
      auto cup = read<Cup>(event.address);
      if (cup->distance <= farthest_)
        lines_ << event.time.count() << ',' << cup->label << ',' << cup->distance << std::endl;
    });
  }
};
CASTOR_COMPONENT(Logbook, "writes a line for every cup that is added")
