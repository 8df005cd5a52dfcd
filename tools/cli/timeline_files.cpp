#include "castor/tools/cli/timeline_files.hpp"

#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/rasterise.hpp"
#include "castor/tools/cli/writable.hpp"
#include "castor/tools/timeline/page.hpp"
#include "castor/tools/timeline/svg.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace castor::cli {

namespace {

/// As sharp as screens and paper are.
constexpr double png_scale = 2;

} // namespace

std::string check_timeline_file(const std::string& name) {
  const std::filesystem::path file{name};
  auto ending = file.extension();
  if (ending != ".html" && ending != ".svg" && ending != ".png")
    return "a timeline is written as a page (.html) or as a picture (.svg, .png); " + name +
           " is none of them";
  return check_output_file(name);
}

void TimelineFiles::watch(SystemOptions& options) {
  options.on_entry = [this](const ChangeEvent& event, const EntryPtr& entry) {
    std::lock_guard guard{mutex_};
    if (!ended_)
      stages_.add(event, entry);
  };
}

void TimelineFiles::look_at_beginning(System& system) {
  std::lock_guard guard{mutex_};
  for (auto& name : system.subarchitectures()) {
    auto entries = system.entries(name);
    std::ranges::reverse(entries);
    for (auto& x : entries) {
      ChangeEvent event;
      event.address = x->address;
      event.source = x->writer;
      event.type = x->value.type_ptr();
      event.version = x->version;
      stages_.add(event, x);
    }
  }
}

void TimelineFiles::end(System& system) {
  system.catch_up();
  std::lock_guard guard{mutex_};
  ended_ = true;
}

void TimelineFiles::write(const std::vector<std::string>& files, const std::string& title,
                          std::vector<std::string> subarchitectures) {
  std::lock_guard guard{mutex_};
  auto figure = timeline::make_figure(title, std::move(subarchitectures), stages_, embedded);
  auto layout = timeline::lay_out(figure, timeline::select(figure));
  for (const std::filesystem::path file : files) {
    auto out = create(file);
    if (file.extension() == ".html")
      out << timeline::to_page(figure, layout);
    else if (file.extension() == ".svg")
      out << timeline::to_svg(figure, layout);
    else
      out << as_png(timeline::to_svg(figure, layout), png_scale);
    if (!out.flush())
      throw std::runtime_error("cannot write " + file.string());
  }
}

} // namespace castor::cli
