#include "castor/tests/tools/timeline/support.hpp"

#include "castor/tools/timeline/page.hpp"
#include "castor/tools/timeline/svg.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace castor::timeline::test {

namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

std::string page_of(const Figure& figure) {
  return to_page(figure, lay_out(figure, select(figure)));
}

nlohmann::json data_in(const std::string& page) {
  const std::string begin = "id=\"data\">";
  auto at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(TimelinePage, HoldsAllThereIsAndNeedsNothingElse) {
  Story story;
  story.write(0s, "a", "1", Note{"what it says", {}}).write(0s, "a", "2", Note{"", {"1"}});
  for (auto* id : {"x", "y", "z"})
    story.write(0s, "b", id);
  auto page = page_of(figure_of(story));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  auto data = data_in(page);
  EXPECT_THAT(data["entries"], SizeIs(5));
  EXPECT_EQ(data["versions"][0]["content"]["text"], "what it says");
  EXPECT_EQ(data["versions"][1]["links"], nlohmann::json{0});
  ASSERT_THAT(data["chips"], SizeIs(1));
  EXPECT_THAT(data["chips"][0], SizeIs(3));
}

TEST(TimelinePage, NothingThatEntriesSayIsTakenForMarkup) {
  Story story;
  auto text = "</script><script>alert('1')</script>";
  story.write(0s, "a", "<b>", Note{text, {}});
  auto page = page_of(figure_of(story));
  EXPECT_THAT(page, Not(HasSubstr("</script><script>alert")));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;"));
  EXPECT_EQ(data_in(page)["versions"][0]["content"]["text"], text);
}

TEST(TimelinePage, APictureThatIsSeenInEveryStageIsEmbeddedOnce) {
  Story story;
  story.write(0s, "a", "scene", Sight{{image(320, 240)}, {}, {}});
  story.write(1s, "a", "1").write(2s, "a", "2");
  auto figure = figure_of(story);
  auto svg = to_svg(figure, lay_out(figure, select(figure)));
  auto count = [&](const std::string& x) {
    std::size_t result = 0;
    for (auto at = svg.find(x); at != svg.npos; at = svg.find(x, at + 1))
      ++result;
    return result;
  };
  EXPECT_EQ(count("<image "), 1u);
  EXPECT_EQ(count("<use "), 3u);
}

} // namespace

} // namespace castor::timeline::test
