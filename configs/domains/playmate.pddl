; The PlayMate's domain: an arm puts things on waypoints of a table. Relations of things are those of
; the waypoints that they are at; a free waypoint can be chosen anew, relative to another one.
(define (domain playmate)
  (:requirements :mapl :typing :derived-predicates :negative-preconditions)
  (:types agent thing waypoint - object)
  (:state-variables (pos ?t - thing) - waypoint)
  (:predicates
    (wp-left-of ?a ?b - waypoint) (wp-right-of ?a ?b - waypoint) (wp-near ?a ?b - waypoint)
    (left-of ?a ?b - thing) (right-of ?a ?b - thing) (near ?a ?b - thing)
    (taken ?w - waypoint))

  (:derived (taken ?w - waypoint) (exists (?t - thing) (= (pos ?t) ?w)))
  (:derived (left-of ?a ?b - thing)
    (exists (?v ?w - waypoint) (and (= (pos ?a) ?v) (= (pos ?b) ?w) (wp-left-of ?v ?w))))
  (:derived (right-of ?a ?b - thing)
    (exists (?v ?w - waypoint) (and (= (pos ?a) ?v) (= (pos ?b) ?w) (wp-right-of ?v ?w))))
  (:derived (near ?a ?b - thing)
    (exists (?v ?w - waypoint) (and (= (pos ?a) ?v) (= (pos ?b) ?w) (wp-near ?v ?w))))

  (:action move
    :agent (?a - agent) :parameters (?t - thing ?to - waypoint)
    :precondition (and (K ?a (pos ?t)) (not (taken ?to)))
    :effect (assign (pos ?t) ?to))

  ; A waypoint that was chosen anew is in no other relation any more.
  (:action reposition-left
    :agent (?a - agent) :parameters (?target ?landmark - waypoint)
    :precondition (and (not (taken ?target)) (not (= ?target ?landmark)))
    :effect (and (forall (?w - waypoint)
                   (and (not (wp-left-of ?target ?w)) (not (wp-left-of ?w ?target))
                        (not (wp-right-of ?target ?w)) (not (wp-right-of ?w ?target))
                        (not (wp-near ?target ?w)) (not (wp-near ?w ?target))))
                 (wp-left-of ?target ?landmark) (wp-right-of ?landmark ?target)
                 (wp-near ?target ?landmark)))
  (:action reposition-right
    :agent (?a - agent) :parameters (?target ?landmark - waypoint)
    :precondition (and (not (taken ?target)) (not (= ?target ?landmark)))
    :effect (and (forall (?w - waypoint)
                   (and (not (wp-left-of ?target ?w)) (not (wp-left-of ?w ?target))
                        (not (wp-right-of ?target ?w)) (not (wp-right-of ?w ?target))
                        (not (wp-near ?target ?w)) (not (wp-near ?w ?target))))
                 (wp-right-of ?target ?landmark) (wp-left-of ?landmark ?target)
                 (wp-near ?target ?landmark)))
  (:action reposition-near
    :agent (?a - agent) :parameters (?target ?landmark - waypoint)
    :precondition (and (not (taken ?target)) (not (= ?target ?landmark)))
    :effect (wp-near ?target ?landmark)))
