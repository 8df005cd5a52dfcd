#include "castor/planning/symbolic/evaluation.hpp"

#include "castor/planning/symbolic/pddl_reader.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::planning {
namespace {

/// Whether the condition holds for the cup a, where a and b are cups and k is a room.
bool is_so(const std::string& condition, const std::string& facts) {
  const auto read = parse_pddl(
    "d",
    "(define (domain d) (:requirements :adl :typing) (:types cup room - object) (:constants b - "
    "cup) (:predicates (red ?c - cup) (in ?c - cup ?r - room)) (:action look :parameters (?x - "
    "cup) :precondition " +
      condition + " :effect (red ?x)))",
    "p",
    "(define (problem p) (:domain d) (:objects a - cup k - room) (:init " + facts +
      ") (:goal (red a)))");
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  const auto& action = read.task.actions.at(0);
  // Constants come first.
  return holds(read.task, action.precondition, action.variables, {1},
               {read.task.initial.begin(), read.task.initial.end()});
}

TEST(Evaluation, UnderstandsConditions) {
  EXPECT_TRUE(is_so("(red ?x)", "(red a)"));
  EXPECT_FALSE(is_so("(red ?x)", "(red b)"));
  EXPECT_TRUE(is_so("(not (red ?x))", "(red b)"));
  EXPECT_TRUE(is_so("(red b)", "(red b)"));
  EXPECT_TRUE(is_so("(and)", ""));
  EXPECT_FALSE(is_so("(or)", ""));
  EXPECT_TRUE(is_so("(or (red ?x) (red b))", "(red b)"));
  EXPECT_FALSE(is_so("(and (red ?x) (red b))", "(red b)"));
  EXPECT_TRUE(is_so("(not (= ?x b))", ""));
  EXPECT_TRUE(is_so("(imply (red b) (red ?x))", ""));
  EXPECT_TRUE(is_so("(exists (?r - room) (in ?x ?r))", "(in a k)"));
  EXPECT_FALSE(is_so("(exists (?r - room) (in ?x ?r))", "(in b k)"));
  EXPECT_TRUE(is_so("(forall (?c - cup) (exists (?r - room) (in ?c ?r)))", "(in a k) (in b k)"));
  EXPECT_FALSE(is_so("(forall (?c - cup) (exists (?r - room) (in ?c ?r)))", "(in a k)"));
  // Only objects of the type count.
  EXPECT_TRUE(is_so("(forall (?c - cup) (red ?c))", "(red a) (red b)"));
}

} // namespace
} // namespace castor::planning
