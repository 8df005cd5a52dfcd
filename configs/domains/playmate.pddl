; The PlayMate's domain: an arm puts things on waypoints of a table. Relations of things are those of the
; waypoints that they are at, to other things. Each thing is at a waypoint of its own; others are free, and
; can be chosen: relative to things, in a part of the table, or anywhere; in several ways, if all are to hold.
(define (domain playmate)
  (:requirements :mapl :typing :derived-predicates :negative-preconditions)
  (:types agent thing waypoint part relation - object)
  (:constants hand - waypoint
    rel-left rel-right rel-front rel-back rel-near rel-away rel-between rel-on rel-in - relation)
  (:state-variables (pos ?t - thing) - waypoint)
  (:predicates
    (wp-left-of ?w - waypoint ?t - thing)
    (wp-right-of ?w - waypoint ?t - thing)
    (wp-front-of ?w - waypoint ?t - thing)
    (wp-back-of ?w - waypoint ?t - thing)
    (wp-near ?w - waypoint ?t - thing)
    (wp-away-from ?w - waypoint ?t - thing)
    (wp-between ?w - waypoint ?a ?b - thing) (wp-on ?w - waypoint ?t - thing)
    (wp-in ?w - waypoint ?p - part)
    (left-of ?a ?b - thing) (right-of ?a ?b - thing) (front-of ?a ?b - thing) (back-of ?a ?b - thing)
    (near ?a ?b - thing) (away-from ?a ?b - thing) (between ?a ?b ?c - thing) (on ?a ?b - thing)
    (in-part ?a - thing ?p - part)
    (held ?t - thing) (pushed ?t - thing) (loaded ?t - thing)
    ; The arm has found out that the first has to be moved before the second.
    (in-way ?a ?b - thing) (hampered ?t - thing)
    (taken ?w - waypoint)
    ; It has been chosen in some way, or something was at it.
    (chosen ?w - waypoint) (used ?w - waypoint)
    ; The goal does not speak of it: no places are chosen in that relation, and nothing is put where
    ; something was before.
    (unasked ?r - relation) (unwanted ?w - waypoint)
    ; Things that nothing can stand on, or is to; and things that are not to be touched.
    (no-flat-top ?t - thing) (kept ?t - thing))

  (:derived (taken ?w - waypoint) (exists (?t - thing) (= (pos ?t) ?w)))
  (:derived (held ?t - thing) (= (pos ?t) hand))
  (:derived (left-of ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-left-of ?w ?b))))
  (:derived (right-of ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-right-of ?w ?b))))
  (:derived (front-of ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-front-of ?w ?b))))
  (:derived (back-of ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-back-of ?w ?b))))
  (:derived (near ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-near ?w ?b))))
  (:derived (away-from ?a ?b - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-away-from ?w ?b))))
  (:derived (between ?a ?b ?c - thing)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-between ?w ?b ?c))))
  (:derived (on ?a ?b - thing) (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-on ?w ?b))))
  (:derived (loaded ?b - thing) (exists (?a - thing) (on ?a ?b)))
  (:derived (hampered ?b - thing) (exists (?a - thing) (in-way ?a ?b)))
  (:derived (in-part ?a - thing ?p - part)
    (exists (?w - waypoint) (and (= (pos ?a) ?w) (wp-in ?w ?p))))

  ; From where a thing was taken, another can be put. What was chosen relative to a thing that is moved
  ; away is not there any more.
  (:action move
    :agent (?a - agent) :parameters (?t - thing ?to - waypoint)
    :precondition (and (K ?a (pos ?t)) (not (taken ?to)) (not (loaded ?t)) (not (hampered ?t))
                       (or (= (pos ?t) hand) (not (kept ?t)))
                       (not (= ?to hand)) (or (chosen ?to) (and (used ?to) (not (unwanted ?to))))
                       (or (= (pos ?t) hand) (not (taken hand))))
    :effect (and (forall (?w - waypoint)
                   (and (when (= (pos ?t) ?w) (used ?w))
                        (not (wp-left-of ?w ?t)) (not (wp-right-of ?w ?t)) (not (wp-front-of ?w ?t))
                        (not (wp-back-of ?w ?t)) (not (wp-near ?w ?t)) (not (wp-away-from ?w ?t))
                        (forall (?o - thing)
                          (and (not (wp-between ?w ?t ?o)) (not (wp-between ?w ?o ?t))))))
                 (forall (?o - thing) (not (in-way ?t ?o)))
                 (assign (pos ?t) ?to)))
  (:action take
    :agent (?a - agent) :parameters (?t - thing)
    :precondition (and (K ?a (pos ?t)) (not (taken hand)) (not (loaded ?t)) (not (hampered ?t))
                       (not (kept ?t)))
    :effect (and (forall (?w - waypoint)
                   (and (when (= (pos ?t) ?w) (used ?w))
                        (not (wp-left-of ?w ?t)) (not (wp-right-of ?w ?t)) (not (wp-front-of ?w ?t))
                        (not (wp-back-of ?w ?t)) (not (wp-near ?w ?t)) (not (wp-away-from ?w ?t))
                        (forall (?o - thing)
                          (and (not (wp-between ?w ?t ?o)) (not (wp-between ?w ?o ?t))))))
                 (forall (?o - thing) (not (in-way ?t ?o)))
                 (assign (pos ?t) hand)))
  (:action push
    :agent (?a - agent) :parameters (?t - thing)
    :precondition (and (K ?a (pos ?t)) (not (taken hand)) (not (loaded ?t)) (not (kept ?t)))
    :effect (pushed ?t))

  ; A waypoint that nothing has been at is chosen.
  (:action reposition-left
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-left)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-left-of ?target ?landmark)))
  (:action reposition-right
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-right)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-right-of ?target ?landmark)))
  (:action reposition-front
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-front)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-front-of ?target ?landmark)))
  (:action reposition-back
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-back)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-back-of ?target ?landmark)))
  (:action reposition-near
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-near)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-near ?target ?landmark)))
  (:action reposition-away
    :agent (?a - agent) :parameters (?target - waypoint ?landmark - thing)
    :precondition (and (not (unasked rel-away)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (held ?landmark)))
    :effect (and (chosen ?target) (wp-away-from ?target ?landmark)))
  (:action reposition-between
    :agent (?a - agent) :parameters (?target - waypoint ?one ?other - thing)
    :precondition (and (not (unasked rel-between)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)) (not (= ?one ?other)) (not (held ?one))
                       (not (held ?other)))
    :effect (and (chosen ?target) (wp-between ?target ?one ?other)
                 (wp-between ?target ?other ?one)))
  (:action reposition-on
    :agent (?a - agent) :parameters (?target - waypoint ?below - thing)
    :precondition (and (not (unasked rel-on)) (not (chosen ?target)) (not (taken ?target))
                       (not (used ?target)) (not (= ?target hand))
                       (not (loaded ?below)) (not (no-flat-top ?below)) (not (held ?below)))
    :effect (and (chosen ?target) (wp-on ?target ?below)))
  (:action reposition-in
    :agent (?a - agent) :parameters (?target - waypoint ?where - part)
    :precondition (and (not (unasked rel-in)) (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)))
    :effect (and (chosen ?target) (wp-in ?target ?where)))
  (:action reposition-free
    :agent (?a - agent) :parameters (?target - waypoint)
    :precondition (and (not (taken ?target)) (not (used ?target))
                       (not (= ?target hand)))
    :effect (chosen ?target)))
