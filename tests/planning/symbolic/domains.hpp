#pragma once

#include <string>

/// Small domains of the tests' own.
namespace castor::test {

/// A robot carries one cup at a time from room to room; doors may be shut.
inline const std::string cups_domain = R"(
(define (domain cups)
  (:requirements :typing :negative-preconditions :action-costs)
  (:types room thing - object cup book - thing)
  (:predicates (robot-at ?r - room) (at ?t - thing ?r - room) (holding ?t - thing) (busy)
               (door ?a ?b - room) (shut ?a ?b - room))
  (:functions (distance ?a ?b - room) (total-cost))
  (:action go :parameters (?a ?b - room)
    :precondition (and (robot-at ?a) (door ?a ?b) (not (shut ?a ?b)))
    :effect (and (robot-at ?b) (not (robot-at ?a)) (increase (total-cost) (distance ?a ?b))))
  (:action take :parameters (?t - thing ?r - room)
    :precondition (and (robot-at ?r) (at ?t ?r) (not (busy)))
    :effect (and (holding ?t) (busy) (not (at ?t ?r)) (increase (total-cost) 1)))
  (:action put :parameters (?t - thing ?r - room)
    :precondition (and (robot-at ?r) (holding ?t))
    :effect (and (at ?t ?r) (not (holding ?t)) (not (busy)) (increase (total-cost) 1)))))";

inline const std::string cups_problem = R"(
(define (problem two-cups) (:domain cups)
  (:objects kitchen hall study - room red blue - cup)
  (:init (robot-at hall) (at red kitchen) (at blue study)
    (door hall kitchen) (door kitchen hall) (door hall study) (door study hall)
    (door kitchen study) (door study kitchen)
    (= (distance hall kitchen) 2) (= (distance kitchen hall) 2) (= (distance hall study) 2)
    (= (distance study hall) 2) (= (distance kitchen study) 9) (= (distance study kitchen) 9)
    (= (total-cost) 0))
  (:goal (and (at red study) (at blue kitchen)))
  (:metric minimize (total-cost))))";

/// Quantifiers, conditional effects and derived predicates: a lamp lights what is connected to it.
inline const std::string lamps_domain = R"(
(define (domain lamps)
  (:requirements :adl :derived-predicates)
  (:types node)
  (:predicates (wire ?a ?b - node) (on ?a ?b - node) (source ?a - node) (live ?a - node)
               (dark) (broken ?a - node))
  (:derived (live ?a - node)
    (or (source ?a) (exists (?b - node) (and (on ?b ?a) (live ?b)))))
  (:derived (dark) (forall (?a - node) (or (source ?a) (not (live ?a)))))
  (:action switch :parameters (?a ?b - node)
    :precondition (and (wire ?a ?b) (not (broken ?a)))
    :effect (and (when (on ?a ?b) (not (on ?a ?b))) (when (not (on ?a ?b)) (on ?a ?b))))
  (:action cut-all :parameters ()
    :precondition (not (dark))
    :effect (forall (?a ?b - node) (when (and (on ?a ?b) (not (source ?a))) (not (on ?a ?b)))))))";

} // namespace castor::test
