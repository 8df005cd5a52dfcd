#include "castor/wm/store/entry_store.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using std::chrono::microseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace other_boxes {

/// The name of another type, with other fields.
struct Box {
  int size = 0;
};
CASTOR_REFLECT(Box, size)

} // namespace other_boxes

class EntryStoreRules : public testing::Test {
protected:
  EntryStoreRules() { store.access().allow("spatial"); }

  WriteRequest request(Operation operation, const std::string& id, Value value = {},
                       std::optional<Version> last_seen = {},
                       const std::string& writer = "segmentor") {
    return {operation,
            {"vision", id},
            std::move(value),
            last_seen,
            std::make_shared<const Client>(Client{writer, "vision"})};
  }

  /// Prepares and commits what must succeed.
  ChangeEvent write(const WriteRequest& x, microseconds now = {}) {
    auto effect = store.prepare(x);
    if (!effect)
      throw std::logic_error(effect.failure().message);
    return *store.commit(*effect, now);
  }

  ChangeEvent add(const std::string& id, Value value = Value::of(Box{})) {
    return write(request(Operation::add, id, std::move(value)));
  }

  ChangeEvent overwrite(const std::string& id, Version last_seen, Value value = Value::of(Box{}),
                        const std::string& writer = "segmentor") {
    return write(request(Operation::overwrite, id, std::move(value), last_seen, writer));
  }

  ChangeEvent remove(const std::string& id) { return write(request(Operation::remove, id)); }

  Failure refused(const WriteRequest& x) {
    auto effect = store.prepare(x);
    EXPECT_FALSE(effect.ok());
    return effect ? Failure{} : effect.failure();
  }

  std::vector<std::string> ids(const TypeQuery& query) {
    std::vector<std::string> result;
    for (auto& entry : store.read_by_type(query))
      result.push_back(entry->address.id);
    return result;
  }

  EntryStore store{"vision"};
};

} // namespace

TEST_F(EntryStoreRules, DeletesOnlyTheVersionThatIsMeantIfOneIs) {
  add("0:1");
  overwrite("0:1", 0);
  auto failure = refused(request(Operation::remove, "0:1", {}, Version{0}));
  EXPECT_EQ(failure.kind, FailureKind::inconsistent);
  EXPECT_THAT(failure.message, HasSubstr("has seen version 0, but"));
  write(request(Operation::remove, "0:1", {}, Version{1}));
  EXPECT_FALSE(store.exists("0:1"));
}

TEST_F(EntryStoreRules, StartsEmpty) {
  EXPECT_EQ(store.size(), 0u);
  EXPECT_EQ(store.sequence(), 0u);
  EXPECT_EQ(store.subarchitecture(), "vision");
  EXPECT_THAT(ids({}), IsEmpty());
}

TEST_F(EntryStoreRules, GivesBackWhatWasAdded) {
  add("0:1", Value::of(signed_box()));
  auto entry = *store.read("0:1");
  EXPECT_EQ(entry->address, (Address{"vision", "0:1"}));
  EXPECT_EQ(entry->version, 0u);
  EXPECT_EQ(entry->writer, "segmentor");
  EXPECT_EQ(entry->type_name(), "SignedBox");
  EXPECT_EQ(*entry->value.as<SignedBox>(), signed_box());
  EXPECT_TRUE(store.exists("0:1"));
  EXPECT_EQ(store.size(), 1u);
}

TEST_F(EntryStoreRules, SharesTheValueWithTheWriter) {
  auto value = Value::of(signed_box());
  add("0:1", value);
  EXPECT_EQ((*store.read("0:1"))->value.as<SignedBox>(), value.as<SignedBox>());
}

TEST_F(EntryStoreRules, LeavesAnEntryThatWasReadAsItWas) {
  add("0:1", Value::of(Tree{"old", {}}));
  auto before = *store.read("0:1");
  overwrite("0:1", 0, Value::of(Tree{"new", {}}), "tracker");
  EXPECT_EQ(before->value.as<Tree>()->name, "old");
  EXPECT_EQ(before->version, 0u);
  EXPECT_EQ(before->writer, "segmentor");
  auto after = *store.read("0:1");
  EXPECT_EQ(after->value.as<Tree>()->name, "new");
  EXPECT_EQ(after->version, 1u);
  EXPECT_EQ(after->writer, "tracker");
}

TEST_F(EntryStoreRules, RefusesASecondAdd) {
  add("0:1", Value::of(SignedBox{}));
  auto failure = refused(request(Operation::add, "0:1", Value::of(Box{}), {}, "tracker"));
  EXPECT_EQ(failure.kind, FailureKind::already_exists);
  EXPECT_EQ(failure.address, (Address{"vision", "0:1"}));
  EXPECT_THAT(failure.message, AllOf(HasSubstr("tracker of vision"), HasSubstr("vision/0:1"),
                                     HasSubstr("segmentor put a SignedBox"),
                                     HasSubstr("Overwrite it"), HasSubstr("new id")));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteOfWhatNeverWas) {
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(Box{}), 0));
  EXPECT_EQ(failure.kind, FailureKind::does_not_exist);
  EXPECT_EQ(failure.address, (Address{"vision", "0:1"}));
  EXPECT_THAT(failure.message,
              AllOf(HasSubstr("segmentor of vision cannot overwrite vision/0:1"),
                    HasSubstr("nothing was added there"), HasSubstr("Add it first")));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteOfWhatWasDeleted) {
  add("0:1");
  remove("0:1");
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(Box{}), 0));
  EXPECT_EQ(failure.kind, FailureKind::does_not_exist);
  EXPECT_THAT(failure.message, HasSubstr("it was deleted"));
}

TEST_F(EntryStoreRules, RefusesADeletionOfWhatIsNotThere) {
  auto failure = refused(request(Operation::remove, "0:1"));
  EXPECT_EQ(failure.kind, FailureKind::does_not_exist);
  EXPECT_THAT(failure.message, AllOf(HasSubstr("cannot delete vision/0:1"),
                                     HasSubstr("nothing was added"), Not(HasSubstr("Add it"))));
  add("0:1");
  remove("0:1");
  EXPECT_THAT(refused(request(Operation::remove, "0:1")).message, HasSubstr("it was deleted"));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteBySomebodyWhoNeverRead) {
  add("0:1");
  overwrite("0:1", 0);
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(Box{}), {}, "tracker"));
  EXPECT_EQ(failure.kind, FailureKind::inconsistent);
  EXPECT_EQ(failure.address, (Address{"vision", "0:1"}));
  EXPECT_THAT(failure.message,
              AllOf(HasSubstr("tracker of vision cannot overwrite vision/0:1"),
                    HasSubstr("never read"), HasSubstr("segmentor wrote version 1"),
                    HasSubstr("Read it first")));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteOfAVersionThatHasPassed) {
  add("0:1");
  overwrite("0:1", 0);
  overwrite("0:1", 1, Value::of(Box{}), "tracker");
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(Box{}), 1));
  EXPECT_EQ(failure.kind, FailureKind::inconsistent);
  EXPECT_THAT(failure.message, AllOf(HasSubstr("segmentor of vision cannot overwrite vision/0:1"),
                                     HasSubstr("seen version 1"), HasSubstr("tracker"),
                                     HasSubstr("version 2"), HasSubstr("Read it again")));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteOfAVersionToCome) {
  add("0:1");
  EXPECT_EQ(refused(request(Operation::overwrite, "0:1", Value::of(Box{}), 1)).kind,
            FailureKind::inconsistent);
}

TEST_F(EntryStoreRules, RefusesAnOverwriteThatCountsOnAnotherWritersVersion) {
  add("x");
  overwrite("x", 0, Value::of(Box{}), "tracker");
  auto x = request(Operation::overwrite, "x", Value::of(Box{}), 1);
  x.expected = true;
  auto failure = store.prepare(x).failure();
  EXPECT_EQ(failure.kind, FailureKind::inconsistent);
  EXPECT_THAT(failure.message, HasSubstr("version 1 is by tracker"));
  overwrite("x", 1);
  x.last_seen = 2;
  EXPECT_TRUE(store.prepare(x));
}

TEST_F(EntryStoreRules, RefusesAnOverwriteOfAnEntryThatWasDeletedAndAddedAgain) {
  add("0:1");
  remove("0:1");
  add("0:1");
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(Box{}), 0));
  EXPECT_EQ(failure.kind, FailureKind::inconsistent);
  EXPECT_THAT(failure.message, AllOf(HasSubstr("version 0"), HasSubstr("version 1")));
}

TEST_F(EntryStoreRules, LetsAnybodyDeleteWithoutReading) {
  add("0:1");
  auto event = write(request(Operation::remove, "0:1", {}, {}, "tracker"));
  EXPECT_EQ(event.source, "tracker");
  EXPECT_FALSE(store.exists("0:1"));
}

TEST_F(EntryStoreRules, RefusesAnotherTypeOverAnEntry) {
  add("0:1", Value::of(Box{}));
  auto failure = refused(request(Operation::overwrite, "0:1", Value::of(SignedBox{}), 0));
  EXPECT_EQ(failure.kind, FailureKind::wrong_type);
  EXPECT_THAT(failure.message,
              AllOf(HasSubstr("segmentor of vision"), HasSubstr("vision/0:1"), HasSubstr("a Box"),
                    HasSubstr("with a SignedBox"), HasSubstr("Delete it and add")));
}

TEST_F(EntryStoreRules, TakesAnotherTypeWhenAnIdIsUsedAgain) {
  add("0:1", Value::of(Box{}));
  remove("0:1");
  auto event = add("0:1", Value::of(Point{}));
  EXPECT_EQ(event.version, 1u);
  EXPECT_EQ(event.type_name(), "Point");
  EXPECT_THAT(ids({"vision", "Box"}), IsEmpty());
  EXPECT_THAT(ids({"vision", "Point"}), ElementsAre("0:1"));
}

TEST_F(EntryStoreRules, RefusesAnotherLayoutOfAKnownType) {
  add("0:1", Value::of(Box{}));
  for (auto& x : {request(Operation::add, "0:2", Value::of(other_boxes::Box{})),
                  request(Operation::overwrite, "0:1", Value::of(other_boxes::Box{}), 0)}) {
    auto failure = refused(x);
    EXPECT_EQ(failure.kind, FailureKind::wrong_type);
    EXPECT_EQ(failure.address, x.address);
    EXPECT_THAT(failure.message,
                AllOf(HasSubstr("segmentor of vision"), HasSubstr(to_string(x.address)),
                      HasSubstr(to_string(*descriptor_of<Box>())),
                      HasSubstr(to_string(*descriptor_of<other_boxes::Box>())),
                      HasSubstr("one declaration")));
  }
}

TEST_F(EntryStoreRules, RemembersTheLayoutOfATypeWhenItsLastEntryIsGone) {
  add("0:1", Value::of(Box{}));
  remove("0:1");
  EXPECT_EQ(refused(request(Operation::add, "0:2", Value::of(other_boxes::Box{}))).kind,
            FailureKind::wrong_type);
}

TEST_F(EntryStoreRules, RefusesEveryWriteFromASubarchitectureWithoutAccess) {
  add("0:1");
  for (auto [operation, verb] :
       {std::pair(Operation::add, "add"), std::pair(Operation::overwrite, "overwrite"),
        std::pair(Operation::remove, "delete")}) {
    WriteRequest x{operation,
                   {"vision", "0:1"},
                   Value::of(Box{}),
                   0,
                   std::make_shared<const Client>(Client{"planner", "planning"})};
    auto failure = refused(x);
    EXPECT_EQ(failure.kind, FailureKind::not_permitted);
    EXPECT_EQ(failure.address, x.address);
    EXPECT_THAT(failure.message,
                AllOf(HasSubstr("planner of planning may not " + std::string{verb}),
                      HasSubstr("vision/0:1"), HasSubstr("only components of vision"),
                      HasSubstr("ACCESS planning WRITES vision")));
  }
}

TEST_F(EntryStoreRules, TakesWritesFromASubarchitectureWithAccess) {
  write({Operation::add,
         {"vision", "0:1"},
         Value::of(Box{}),
         {},
         std::make_shared<const Client>(Client{"mapper", "spatial"})});
  EXPECT_EQ((*store.read("0:1"))->writer, "mapper");
}

TEST_F(EntryStoreRules, AddsNoEntryThatIsToBeTheOnlyOneOfItsIdAfterAnother) {
  auto only = request(Operation::add, "0:1", Value::of(Box{}));
  only.life = EntryLife{.only_once = true};
  write(only);
  EXPECT_EQ(refused(only).kind, FailureKind::already_exists);
  write(request(Operation::remove, "0:1"));
  EXPECT_EQ(refused(only).kind, FailureKind::already_exists);
  EXPECT_THAT(refused(only).message, HasSubstr("its id was used before"));
}

TEST_F(EntryStoreRules, SaysWhyThereIsNothingToRead) {
  auto missing = store.read("0:1").failure();
  EXPECT_EQ(missing.kind, FailureKind::does_not_exist);
  EXPECT_EQ(missing.address, (Address{"vision", "0:1"}));
  EXPECT_THAT(missing.message, AllOf(HasSubstr("vision/0:1"), HasSubstr("nothing was added")));
  add("0:1");
  remove("0:1");
  EXPECT_THAT(store.read("0:1").failure().message, HasSubstr("it was deleted"));
}

TEST_F(EntryStoreRules, CountsVersionsFromZeroAndOnThroughDeletion) {
  EXPECT_EQ(add("0:1").version, 0u);
  EXPECT_EQ(overwrite("0:1", 0).version, 1u);
  EXPECT_EQ(overwrite("0:1", 1).version, 2u);
  EXPECT_EQ(remove("0:1").version, 2u);
  EXPECT_EQ(*store.version("0:1"), 2u);
  EXPECT_EQ(add("0:1").version, 3u);
  EXPECT_EQ(*store.version("0:1"), 3u);
  EXPECT_EQ(add("0:2").version, 0u);
}

TEST_F(EntryStoreRules, KnowsNoVersionOfWhatNeverWas) {
  auto failure = store.version("0:1").failure();
  EXPECT_EQ(failure.kind, FailureKind::does_not_exist);
  EXPECT_THAT(failure.message, HasSubstr("vision/0:1"));
}

TEST_F(EntryStoreRules, StartsAForgottenIdAboveEveryForgottenVersion) {
  store = EntryStore{"vision", {.remembered_deletions = 1}};
  add("a");
  overwrite("a", 0);
  overwrite("a", 1);
  remove("a");
  EXPECT_EQ(*store.version("a"), 2u);
  add("b");
  remove("b");
  EXPECT_FALSE(store.version("a").ok());
  EXPECT_EQ(*store.version("b"), 0u);
  EXPECT_EQ(add("b").version, 1u);
  EXPECT_EQ(add("a").version, 3u);
  EXPECT_EQ(add("never seen").version, 3u);
}

TEST_F(EntryStoreRules, SaysThatADeletionMayBeForgotten) {
  constexpr auto perhaps = "deleted too long ago to be remembered";
  EXPECT_THAT(store.read("a").failure().message, Not(HasSubstr(perhaps)));
  store = EntryStore{"vision", {.remembered_deletions = 0}};
  add("a");
  remove("a");
  EXPECT_THAT(store.read("a").failure().message, HasSubstr(perhaps));
  EXPECT_THAT(store.version("a").failure().message, HasSubstr(perhaps));
  EXPECT_THAT(refused(request(Operation::remove, "a")).message, HasSubstr(perhaps));
}

TEST_F(EntryStoreRules, MayBeToldToRememberNoDeletions) {
  store = EntryStore{"vision", {.remembered_deletions = 0}};
  add("a");
  overwrite("a", 0);
  remove("a");
  EXPECT_FALSE(store.version("a").ok());
  EXPECT_EQ(add("a").version, 2u);
}

TEST_F(EntryStoreRules, RemembersADeletionHoweverOftenAnotherIdComesAndGoes) {
  store = EntryStore{"vision", {.remembered_deletions = 2}};
  add("a");
  overwrite("a", 0);
  remove("a");
  for (int i = 0; i < 100; ++i) {
    add("b");
    remove("b");
  }
  ASSERT_TRUE(store.version("a").ok());
  EXPECT_EQ(*store.version("a"), 1u);
  EXPECT_EQ(*store.version("b"), 99u);
}

TEST_F(EntryStoreRules, ForgetsTheLongestDeletedFirst) {
  store = EntryStore{"vision", {.remembered_deletions = 2}};
  for (auto id : {"a", "b"}) {
    add(id);
    remove(id);
  }
  add("a");
  remove("a");
  add("c");
  remove("c");
  EXPECT_TRUE(store.version("a").ok());
  EXPECT_FALSE(store.version("b").ok());
  EXPECT_TRUE(store.version("c").ok());
}

TEST_F(EntryStoreRules, SaysWhatHappenedInEachEvent) {
  auto added = write(request(Operation::add, "0:1", Value::of(SignedBox{})), microseconds{5});
  EXPECT_EQ(added.operation, Operation::add);
  EXPECT_EQ(added.address, (Address{"vision", "0:1"}));
  EXPECT_EQ(added.source, "segmentor");
  EXPECT_EQ(added.type, descriptor_of<SignedBox>());
  EXPECT_EQ(added.version, 0u);
  EXPECT_EQ(added.sequence, 1u);
  EXPECT_EQ(added.time, microseconds{5});
  auto overwritten = overwrite("0:1", 0, Value::of(SignedBox{}), "tracker");
  EXPECT_EQ(overwritten.operation, Operation::overwrite);
  EXPECT_EQ(overwritten.source, "tracker");
  EXPECT_EQ(overwritten.version, 1u);
  EXPECT_EQ(overwritten.sequence, 2u);
  auto removed = remove("0:1");
  EXPECT_EQ(removed.operation, Operation::remove);
  EXPECT_EQ(removed.source, "segmentor");
  EXPECT_EQ(removed.type_name(), "SignedBox");
  EXPECT_EQ(removed.version, 1u);
  EXPECT_EQ(removed.sequence, 3u);
  EXPECT_EQ(store.sequence(), 3u);
}

TEST_F(EntryStoreRules, ChangesNothingUntilTheCommit) {
  add("0:1");
  auto added = store.prepare(request(Operation::add, "0:2", Value::of(Point{})));
  auto overwritten = store.prepare(request(Operation::overwrite, "0:1", Value::of(Box{}), 0));
  auto removed = store.prepare(request(Operation::remove, "0:1"));
  EXPECT_TRUE(added.ok() && overwritten.ok() && removed.ok());
  EXPECT_EQ(store.size(), 1u);
  EXPECT_EQ(store.sequence(), 1u);
  EXPECT_EQ(*store.version("0:1"), 0u);
  EXPECT_FALSE(store.exists("0:2"));
  EXPECT_FALSE(store.version("0:2").ok());
  EXPECT_THAT(ids({}), ElementsAre("0:1"));
}

TEST_F(EntryStoreRules, ReadsATypeInTheOrderOfTheLastWrites) {
  add("a");
  add("b");
  add("c");
  EXPECT_THAT(ids({"vision", "Box"}), ElementsAre("c", "b", "a"));
  overwrite("a", 0);
  EXPECT_THAT(ids({"vision", "Box"}), ElementsAre("a", "c", "b"));
  remove("c");
  EXPECT_THAT(ids({"vision", "Box"}), ElementsAre("a", "b"));
}

TEST_F(EntryStoreRules, ReadsAtMostAsManyAsAskedFor) {
  for (auto id : {"a", "b", "c"})
    add(id);
  EXPECT_THAT(ids({"vision", "Box", 2}), ElementsAre("c", "b"));
  EXPECT_THAT(ids({"vision", "Box", 1}), ElementsAre("c"));
  EXPECT_THAT(ids({"vision", "Box", 0}), ElementsAre("c", "b", "a"));
  EXPECT_THAT(ids({"vision", "Box", 9}), ElementsAre("c", "b", "a"));
}

TEST_F(EntryStoreRules, ReadsDerivedTypesOnlyWhereAsked) {
  add("box", Value::of(Box{}));
  add("painted", Value::of(PaintedBox{}));
  add("point", Value::of(Point{}));
  add("signed", Value::of(SignedBox{}));
  add("crate", Value::of(Crate{}));
  EXPECT_THAT(ids({"vision", "Box"}), ElementsAre("box"));
  EXPECT_THAT(ids({"vision", "Box", 0, true}), ElementsAre("crate", "signed", "painted", "box"));
  EXPECT_THAT(ids({"vision", "PaintedBox", 0, true}), ElementsAre("signed", "painted"));
  overwrite("box", 0, Value::of(Box{}));
  EXPECT_THAT(ids({"vision", "Box", 2, true}), ElementsAre("box", "crate"));
}

TEST_F(EntryStoreRules, ReadsASuperTypeThatNoEntryHasItself) {
  add("signed", Value::of(SignedBox{}));
  EXPECT_THAT(ids({"vision", "Box"}), IsEmpty());
  EXPECT_THAT(ids({"vision", "Box", 0, true}), ElementsAre("signed"));
  EXPECT_THAT(ids({"vision", "Nonsense", 0, true}), IsEmpty());
}

TEST_F(EntryStoreRules, ReadsEveryTypeWhereNoneIsNamed) {
  add("box", Value::of(Box{}));
  add("point", Value::of(Point{}));
  add("tree", Value::of(Tree{}));
  EXPECT_THAT(ids({"vision", ""}), ElementsAre("tree", "point", "box"));
  EXPECT_THAT(ids({"vision", "", 1}), ElementsAre("tree"));
  EXPECT_THAT(ids({"vision", "", 0, true}), ElementsAre("tree", "point", "box"));
}

TEST_F(EntryStoreRules, LetOthersOverwriteWhatIsWritableByAll) {
  auto stranger = std::make_shared<const Client>(Client{"arm", "manipulation"});
  auto addition = request(Operation::add, "open", Value::of(Box{}));
  addition.life = EntryLife{.writable_by_all = true};
  write(addition);
  add("closed");
  auto by = [&](const ClientPtr& client, Operation operation, const std::string& id) {
    auto x = request(operation, id, Value::of(Box{}), 0);
    x.client = client;
    return store.prepare(x);
  };
  EXPECT_TRUE(by(stranger, Operation::overwrite, "open"));
  EXPECT_EQ(by(stranger, Operation::remove, "open").failure().kind, FailureKind::not_permitted);
  EXPECT_EQ(by(stranger, Operation::overwrite, "closed").failure().kind,
            FailureKind::not_permitted);
  auto ann = std::make_shared<const Client>(Client{"operator:ann", "operator"});
  EXPECT_EQ(by(ann, Operation::overwrite, "open").failure().kind, FailureKind::not_permitted)
    << "operators are bound by their own rules";
}

TEST_F(EntryStoreRules, RefuseAWillOfAnotherType) {
  auto addition = request(Operation::add, "x", Value::of(Box{}));
  addition.last_will = LastWill{Value::of(Point{}), {}};
  auto failure = refused(addition);
  EXPECT_EQ(failure.kind, FailureKind::wrong_type);
  EXPECT_THAT(failure.message, HasSubstr("a Box, that is a Point"));
}

} // namespace castor::test
