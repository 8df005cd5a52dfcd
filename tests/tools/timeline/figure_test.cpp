#include "castor/tests/tools/timeline/support.hpp"

#include "castor/tools/timeline/selection.hpp"

#include <gmock/gmock.h>

namespace castor::timeline::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// "1 added", for all in a cell.
std::vector<std::string> fates(const Figure& figure, std::size_t row, std::size_t column) {
  static const std::map<Fate, std::string> names{{Fate::added, "added"},
                                                 {Fate::changed, "changed"},
                                                 {Fate::unchanged, "unchanged"},
                                                 {Fate::gone, "gone"},
                                                 {Fate::passed, "passed"}};
  std::vector<std::string> result;
  for (auto& x : figure.cell(row, column))
    result.push_back(figure.entries[figure.versions[x.version].entry].address.id + ' ' +
                     names.at(x.fate));
  return result;
}

TEST(TimelineFigure, EveryStageShowsWhatIsThereAndWhatBecameOfIt) {
  Story story;
  story.write(0s, "a", "1").write(0s, "a", "2").write(0s, "a", "short").remove(0s, "a", "short");
  story.write(1s, "a", "1").write(1s, "a", "3");
  story.remove(2s, "a", "2");
  story.write(3s, "a", "2");
  auto figure = figure_of(story, {"a"});
  ASSERT_THAT(figure.columns, SizeIs(4));
  EXPECT_THAT(fates(figure, 0, 0), ElementsAre("1 added", "2 added", "short passed"));
  EXPECT_THAT(fates(figure, 0, 1), ElementsAre("1 changed", "2 unchanged", "3 added"));
  EXPECT_THAT(fates(figure, 0, 2), ElementsAre("1 unchanged", "2 gone", "3 unchanged"));
  EXPECT_THAT(fates(figure, 0, 3), ElementsAre("1 unchanged", "2 added", "3 unchanged"));
}

TEST(TimelineFigure, RowsAreInTheOrderGivenAndOthersFollow) {
  Story story;
  story.write(0s, "castor", "1").write(0s, "b", "1");
  EXPECT_THAT(figure_of(story, {"b", "a"}).rows, ElementsAre("b", "a", "castor"));
}

TEST(TimelineFigure, LinksAreAddressesAndIdsAndOriginsOfOtherEntries) {
  Story story;
  story.write(0s, "a", "1").write(0s, "b", "1").write(0s, "b", "2");
  story.write(1ms, "a", "by address", Pointer{{"b", "1"}});
  story.write(2ms, "a", "by id", Note{"2", {"1", "nowhere"}});
  story.write(3ms, "a", "name of 1");
  story.write(4ms, "a", "own", Note{"own", {}});
  auto figure = figure_of(story);
  auto links = [&](const std::string& id) {
    std::vector<std::string> result;
    for (auto& x : figure.versions)
      if (figure.entries[x.entry].address.id == id)
        for (auto link : x.links)
          result.push_back(to_string(figure.entries[link].address));
    return result;
  };
  EXPECT_THAT(links("by address"), ElementsAre("b/1"));
  EXPECT_THAT(links("by id"), ElementsAre("a/1", "b/2")) << "an id means what is near first";
  EXPECT_THAT(links("name of 1"), ElementsAre("a/1"));
  EXPECT_THAT(links("own"), IsEmpty());
}

TEST(TimelineFigure, ContentIsThereAsJsonAndPicturesAsPictures) {
  Story story;
  Sight sight;
  sight.views = {image(2, 2, 1), image(200, 100)};
  sight.numbers.assign(100, 1.5);
  story.write(0s, "a", "1", sight);
  auto figure = figure_of(story);
  auto& version = figure.versions.at(0);
  EXPECT_NE(version.json.find("... and 60 more"), std::string::npos) << version.json;
  ASSERT_THAT(version.pictures, SizeIs(2));
  EXPECT_EQ(figure.pictures[version.pictures[0]].width, 200) << "the one that shows most is first";
}

TEST(TimelineSelection, AllOfFewAndSomeOfMany) {
  Story story;
  for (int i = 10; i < 15; ++i)
    story.write(0s, "a", std::to_string(i));
  for (int i = 20; i < 80; ++i)
    story.write(0s, "b", std::to_string(i));
  // So that they are worth being seen.
  story.write(1ms, "a", "p", Pointer{{"a", "10"}}).write(1ms, "b", "p", Pointer{{"b", "77"}});
  auto figure = figure_of(story, {"a", "b"});
  auto cells = select(figure);
  ASSERT_THAT(cells, SizeIs(2));
  auto& a = cells[0].front();
  EXPECT_EQ(a.type, "Note");
  EXPECT_THAT(a.shown, SizeIs(5));
  EXPECT_THAT(a.hidden, IsEmpty());
  auto& b = cells[1].front();
  EXPECT_THAT(b.shown, SizeIs(4));
  EXPECT_THAT(b.hidden, SizeIs(56));
}

TEST(TimelineSelection, BooksThatNobodyRefersToAreOnlyCounted) {
  Story story;
  for (auto* id : {"1", "2", "3"})
    story.write(0s, "a", id);
  auto figure = figure_of(story, {"a"});
  auto cells = select(figure);
  EXPECT_THAT(cells[0].front().shown, IsEmpty());
  EXPECT_THAT(cells[0].front().hidden, SizeIs(3));
}

TEST(TimelineSelection, OfManyThoseAreSeenThatWereSeenBefore) {
  Story story;
  for (int i = 10; i < 30; ++i)
    story.write(0s, "a", std::to_string(i));
  story.write(1ms, "a", "p", Pointer{{"a", "10"}});
  for (int i = 25; i < 30; ++i)
    story.write(1s, "a", std::to_string(i));
  auto figure = figure_of(story, {"a"});
  auto cells = select(figure);
  ASSERT_THAT(cells, SizeIs(2));
  auto ids = [&](const Group& x) {
    std::vector<std::string> result;
    for (auto& y : x.shown)
      result.push_back(figure.entries[figure.versions[y.version].entry].address.id);
    return result;
  };
  EXPECT_EQ(ids(cells[0].front()), ids(cells[1].front()));
}

TEST(TimelineSelection, PicturesOfTheSceneComeFirst) {
  Story story;
  story.write(0s, "a", "1").write(0s, "a", "p", Pointer{{"a", "1"}});
  story.write(1ms, "a", "scene", Sight{{image(320, 240)}, {}, {}});
  auto figure = figure_of(story, {"a"});
  EXPECT_EQ(select(figure)[0].front().type, "Sight");
}

} // namespace

} // namespace castor::timeline::test
