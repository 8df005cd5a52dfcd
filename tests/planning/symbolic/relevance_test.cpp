#include "castor/planning/symbolic/relevance.hpp"

#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::planning {

namespace {

/// A lamp is lit by a switch, which only works with power; what it shines on is derived.
const std::string lamps =
  "(define (domain lamps) (:requirements :strips :typing :derived-predicates)\n"
  "(:types lamp - object)\n"
  "(:predicates (lit ?l - lamp) (power) (bright) (cosy) (dusted ?l - lamp))\n"
  "(:derived (bright) (exists (?l - lamp) (lit ?l)))\n"
  "(:derived (cosy) (and (bright) (exists (?l - lamp) (dusted ?l))))\n"
  "(:action turn-on :parameters () :effect (power))\n"
  "(:action switch :parameters (?l - lamp) :precondition (power)\n"
  "  :effect (and (lit ?l) (not (dusted ?l))))\n"
  "(:action dust :parameters (?l - lamp) :effect (dusted ?l)))\n";

NormalTask relevant_for(const std::string& goal) {
  const auto read = parse_pddl(
    "lamps.pddl", lamps, "p.pddl",
    "(define (problem p) (:domain lamps) (:objects a b - lamp) (:init) (:goal " + goal + "))");
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  EXPECT_EQ(find_plan(read.task, {}).outcome, PlanningResult::Outcome::plan);
  auto result = normalise(read.task);
  remove_irrelevant(result);
  return result;
}

} // namespace

TEST(Relevance, WhatTheGoalDoesNotDependOnIsLeftOut) {
  const auto task = relevant_for("(bright)");
  EXPECT_EQ(task.axioms.size(), 1U);
  ASSERT_EQ(task.actions.size(), 2U);
  // Nobody asks whether it is dusted.
  EXPECT_EQ(task.actions.back().effects.size(), 1U);
}

TEST(Relevance, ConditionsOfConditionsStay) {
  const auto task = relevant_for("(cosy)");
  EXPECT_EQ(task.axioms.size(), 2U);
  EXPECT_EQ(task.actions.size(), 3U);
  EXPECT_EQ(task.actions[1].effects.size(), 2U);
}

TEST(Relevance, OfOnePredicateItsActionsAreLeft) {
  const auto task = relevant_for("(dusted a)");
  EXPECT_TRUE(task.axioms.empty());
  // Which makes it so, and which undoes it, with the power for that.
  EXPECT_EQ(task.actions.size(), 3U);
}

} // namespace castor::planning
