// Who declares to know what there is of a kind is asked, and concepts that somebody adds count.
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::binding::test {

struct AnswerAboutRooms {
  ReferenceReply reply;
};
CASTOR_REFLECT(AnswerAboutRooms, reply)

namespace {

using namespace std::chrono_literals;

Feature called(const char* name) {
  return feature(FeatureKind::concept_name, name);
}

/// Knows of two rooms, tells binding of none, and says what a studio is.
class RoomExpert final : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_call<KnowledgeRequest>([](const KnowledgeRequest&) {
      return KnowledgeReply{{{"1", {}, {called("kitchen")}}, {"2", {}, {called("studio")}}}, {}};
    });
    put({binding(), "concepts of rooms"},
        ConceptStatements{"rooms", {{.name = "studio", .is_a = {"room"}}}});
    declare_knowledge_of("room", true);
  }
};

CASTOR_COMPONENT(RoomExpert, "says when it is asked which rooms there are")

/// Asks which rooms there are until there are two.
class RoomAsker final : public UnmanagedComponent {
  void run() override {
    const ReferenceRequest request{{{{{{called("room")}}}, {}}}, {"room"}};
    while (is_running()) {
      auto reply =
        call<ReferenceRequest, ReferenceReply>("binding", request, {.timeout = 5s, .retries = 5});
      if (reply.referents.front().readings.size() == 2) {
        add(AnswerAboutRooms{std::move(reply)});
        return;
      }
      sleep_for(10ms);
    }
  }
};

CASTOR_COMPONENT(RoomAsker, "asks binding which rooms there are")

std::string with_expert(const std::string& subarchitecture_of_expert) {
  return "HOST localhost\n"
         "SUBARCHITECTURE binding\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM ontology OntologySource --files general.ontology\n"
         "CPP UM scorer BindingScorer\n"
         "CPP UM judge BindingJudge\n"
         "CPP UM binder Binder\n"
         "CPP UM references ReferenceResolver\n" +
         subarchitecture_of_expert +
         "SUBARCHITECTURE asker\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM asks RoomAsker\n"
         "ACCESS asker WRITES binding\n";
}

} // namespace

TEST(KnowledgeSystem, AsksWhoKnowsOfAKind) {
  TestSystem system{with_expert("SUBARCHITECTURE rooms\n"
                                "CPP WM SubarchitectureWorkingMemory\n"
                                "CPP TM AlwaysPositiveTaskManager\n"
                                "CPP UM expert RoomExpert\n"
                                "ACCESS rooms WRITES binding\n")};
  system.expect_entry("AnswerAboutRooms in asker", 60s);
  bool is_found = false;
  for (auto& entry : system.system().entries("asker"))
    if (auto x = entry->value.as<AnswerAboutRooms>()) {
      is_found = true;
      ASSERT_EQ(x->reply.unions.size(), 2U);
      EXPECT_EQ(x->reply.unions.front().id, "rooms/1");
      // A studio is a room only since the expert has said so.
      for (auto& reading : x->reply.referents.front().readings)
        EXPECT_EQ(reading.unknown, 0U) << reading.unions.front();
      ASSERT_EQ(x->reply.competences.size(), 1U);
      EXPECT_EQ(x->reply.competences.front().kind, "room");
      ASSERT_TRUE(x->reply.ontology);
      EXPECT_NE(x->reply.ontology_version, 0U);
    }
  EXPECT_TRUE(is_found);
  system.expect_nobody_else_down();
}

} // namespace castor::binding::test
