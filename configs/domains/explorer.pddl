; The Explorer's domain: a robot finds things and tells people where they are. What it does not know
; yet, it promises: actions whose names end in _A are assertions.
(define (domain explorer)
  (:requirements :mapl :typing)
  (:types agent room area-name thing - object
          robot human - agent)
  (:state-variables
    (is-in ?a - agent) - room
    ; Where people say that a thing is, and where the robot has seen it.
    (asserted-position ?t - thing) - room
    (perceived-position ?t - thing) - room
    ; The room that people call so.
    (area-of ?n - area-name) - room)
  (:predicates (connected ?a ?b - room) (has-reached ?r - robot ?n - area-name))

  (:action move
    :agent (?r - robot) :parameters (?to - room) :variables (?from - room)
    :precondition (and (= (is-in ?r) ?from) (connected ?from ?to))
    :effect (assign (is-in ?r) ?to))

  (:action move-to-area
    :agent (?r - robot) :parameters (?n - area-name) :variables (?from ?to - room)
    :precondition (and (= (is-in ?r) ?from) (= (area-of ?n) ?to)
                       (or (= ?from ?to) (connected ?from ?to)))
    :effect (and (assign (is-in ?r) ?to) (has-reached ?r ?n)))
  (:action move-to-area_A
    :agent (?r - robot) :parameters (?n - area-name)
    :replan (K ?r (area-of ?n))
    :effect (has-reached ?r ?n))

  ; Of a human in the same room, who knows.
  (:action ask-val
    :agent (?r - robot) :parameters (?h - human ??var) :variables (?in - room)
    :precondition (and (= (is-in ?r) ?in) (= (is-in ?h) ?in) (K ?h ??var) (not (K ?r ??var)))
    :effect (K ?r ??var))

  (:sensor object-search-in-room
    :agent (?r - robot) :parameters (?t - thing ?in - room)
    :precondition (and (= (is-in ?r) ?in) (= (asserted-position ?t) ?in))
    :sense (= (perceived-position ?t) ?in))
  (:action object-search-in-room_A
    :agent (?r - robot) :parameters (?t - thing)
    :replan (K ?r (asserted-position ?t))
    :effect (K ?r (perceived-position ?t)))

  (:action inform
    :agent (?r - robot) :parameters (?h - human ?t - thing) :variables (?in ?place - room)
    :precondition (and (= (is-in ?r) ?in) (= (is-in ?h) ?in) (= (perceived-position ?t) ?place))
    :effect (K ?h (perceived-position ?t)))
  (:action inform_A
    :agent (?r - robot) :parameters (?h - human ?t - thing)
    :replan (K ?r (perceived-position ?t))
    :effect (K ?h (perceived-position ?t))))
