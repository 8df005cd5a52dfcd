/// Whether the robot judges the statements of NLVR as people do: each is said to it as an assertion
/// about a scene in working memory: as the record of the picture has it, and as vision sees the
/// picture.
///
///     nlvr_benchmark FOLDER [--part looked-at] [--failures] [--structure]
///
/// FOLDER has dev.json and images/. Its directories 0 to 2 are looked at while the grammar is
/// written, the others only counted: `--failures` lists what was judged otherwise in the looked-at
/// part alone. `--structure` leaves the pictures out.

#include "castor/benchmarks/nlvr/nlvr_pictures.hpp"
#include "castor/benchmarks/nlvr/nlvr_scenes.hpp"
#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace castor;
using communication::RhetoricalRelation;

enum class Verdict { accepted, contradicted, not_understood };

/// Statements by label and verdict.
struct Confusion {
  std::size_t of_true[3] = {};
  std::size_t of_false[3] = {};

  std::size_t count(Verdict x) const {
    return of_true[static_cast<std::size_t>(x)] + of_false[static_cast<std::size_t>(x)];
  }
  std::size_t all() const {
    return count(Verdict::accepted) + count(Verdict::contradicted) + count(Verdict::not_understood);
  }
  std::size_t right() const {
    return of_true[static_cast<std::size_t>(Verdict::accepted)] +
           of_false[static_cast<std::size_t>(Verdict::contradicted)];
  }
};

Verdict verdict_of(const communication::test::Reply& reply) {
  if (reply.is_parsed && reply.relation == RhetoricalRelation::acceptance)
    return Verdict::accepted;
  if (reply.is_parsed && reply.relation == RhetoricalRelation::correction)
    return Verdict::contradicted;
  return Verdict::not_understood;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print(const char* part, const Confusion& x) {
  std::printf("%-10s %4zu statements, accuracy %.1f %%, not understood %.1f %%\n", part, x.all(),
              percent(x.right(), x.all()), percent(x.count(Verdict::not_understood), x.all()));
  std::printf("  label  accepted  contradicted  not understood\n");
  std::printf("  true   %8zu  %12zu  %14zu\n", x.of_true[0], x.of_true[1], x.of_true[2]);
  std::printf("  false  %8zu  %12zu  %14zu\n", x.of_false[0], x.of_false[1], x.of_false[2]);
}

bool is_looked_at(const nlvr::Statement& x) {
  return x.directory == "0" || x.directory == "1" || x.directory == "2";
}

struct Options {
  std::filesystem::path folder;
  bool lists_failures = false;
  bool only_looked_at = false;
  bool only_structure = false;
};

/// Without a folder if the arguments are wrong.
Options options_of(int argc, char** argv) {
  Options result;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--failures")
      result.lists_failures = true;
    else if (argument == "--structure")
      result.only_structure = true;
    else if (argument == "--part" && i + 1 < argc && std::string_view{argv[i + 1]} == "looked-at") {
      result.only_looked_at = true;
      ++i;
    } else if (!argument.starts_with("--") && result.folder.empty())
      result.folder = argument;
    else
      return {};
  }
  return result;
}

/// The boxes of a statement in its kind of scene.
using Boxes = std::function<std::vector<nlvr::Items>(const nlvr::Statement&)>;

void judge(const std::vector<nlvr::Statement>& statements, const Boxes& boxes,
           const Options& options) {
  Confusion looked_at;
  Confusion other;
  std::chrono::duration<double, std::milli> time{};
  for (auto& x : statements) {
    const auto scene = nlvr::scene_of(boxes(x));
    communication::test::TableTalk talk{[&scene](auto& asked) { return scene.reply(asked); }};
    const auto begin = std::chrono::steady_clock::now();
    const auto reply = talk.say(x.sentence);
    time += std::chrono::steady_clock::now() - begin;
    const auto verdict = verdict_of(reply);
    auto& confusion = is_looked_at(x) ? looked_at : other;
    ++(x.is_true ? confusion.of_true : confusion.of_false)[static_cast<std::size_t>(verdict)];
    const bool is_right = verdict == (x.is_true ? Verdict::accepted : Verdict::contradicted);
    if (options.lists_failures && is_looked_at(x) && !is_right)
      std::printf("%s %s: %s => %s\n", x.identifier.c_str(), x.is_true ? "true" : "false",
                  x.sentence.c_str(), reply.text.c_str());
  }
  print("looked at", looked_at);
  if (!options.only_looked_at)
    print("others", other);
  const auto all = looked_at.all() + other.all();
  std::printf("%.2f ms per sentence\n", all == 0 ? 0 : time.count() / static_cast<double>(all));
}

void print(const nlvr::Agreement& x) {
  std::printf("items drawn %zu, seen %zu, recall %.1f %%, precision %.1f %%\n", x.drawn, x.seen,
              percent(x.found, x.drawn), percent(x.found, x.seen));
  std::printf("of those found: colour %.1f %%, shape %.1f %%, size %.1f %%\n",
              percent(x.same_colour, x.found), percent(x.same_shape, x.found),
              percent(x.same_size, x.found));
  std::printf("pictures seen as drawn %zu of %zu\n", x.same_pictures, x.pictures);
}

} // namespace

int main(int argc, char** argv) {
  const auto options = options_of(argc, argv);
  if (options.folder.empty()) {
    std::fprintf(stderr,
                 "usage: nlvr_benchmark FOLDER [--part looked-at] [--failures] [--structure]\n");
    return 2;
  }
  const auto file = options.folder / "dev.json";
  if (!std::filesystem::exists(file)) {
    std::printf("SKIP: there is no %s; it is in https://github.com/lil-lab/nlvr\n", file.c_str());
    return 0;
  }
  auto statements = nlvr::read_statements(file);
  if (options.only_looked_at)
    std::erase_if(statements, [](auto& x) { return !is_looked_at(x); });
  std::printf("from structure\n");
  judge(
    statements, [](auto& x) { return x.boxes; }, options);
  const auto images = options.folder / "images";
  if (options.only_structure || !std::filesystem::exists(images))
    return 0;
  std::printf("from pictures\n");
  nlvr::Agreement agreement;
  judge(
    statements,
    [&](auto& x) {
      // Statements are made of the first of six orders of the boxes.
      const auto picture = images / ("dev-" + x.identifier + "-0.png");
      auto seen = nlvr::see_boxes(vision::read_image(picture, {}));
      nlvr::compare(x.boxes, seen, agreement);
      return seen;
    },
    options);
  print(agreement);
  return 0;
}
