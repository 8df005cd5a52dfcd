#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of motivation: what the robot is to do, and why.
namespace castor::planning {

enum class MotiveStatus : std::uint8_t {
  proposed,
  /// Waits for resources.
  queued,
  /// Its goal is being reached.
  active,
  /// A more urgent one needs its resources; its action ends safely, and it is queued again.
  preempted,
  completed,
  /// Was never begun, and will not be.
  rejected,
  /// Was given up.
  dropped
};
CASTOR_REFLECT_ENUM(MotiveStatus, proposed, queued, active, preempted, completed, rejected, dropped)

/// A status that a motive has had.
struct MotiveEvent {
  /// Microseconds since the system began.
  std::int64_t time = 0;
  MotiveStatus status = MotiveStatus::proposed;
  /// In words; may be empty.
  std::string why;

  friend bool operator==(const MotiveEvent&, const MotiveEvent&) = default;
};

/// Something that the robot may want to reach. A generator adds it as `proposed`; the motive
/// manager overwrites it. Deleting it withdraws it.
struct Motive {
  /// Name of the template that it is made of.
  std::string kind;
  AchieveGoal goal;
  /// What is to be done, as an infinitive: "find the book".
  std::string words;
  /// Why, as a clause: "ann said 'find the book'".
  std::string because;
  /// Who asked for it; empty if nobody did.
  std::string asker;
  /// The entry that it was made of.
  AnyEntryPointer cause;
  /// What it is about: two with different goals about the same conflict. May be empty.
  std::string about;
  /// Higher is more urgent; of equal ones the cheaper is first.
  double priority = 0;
  double cost = 1;
  /// Such as arm, base, voice, camera; each is used by one motive at a time.
  std::vector<std::string> resources;
  /// Seconds after which it is dropped if it has not begun; 0 for never.
  double patience = 0;

  MotiveStatus status = MotiveStatus::proposed;
  std::vector<MotiveEvent> history;
};

enum class MotiveReply : std::uint8_t { accepted, already_so, impossible, done };
CASTOR_REFLECT_ENUM(MotiveReply, accepted, already_so, impossible, done)

/// Told to whoever asked for a motive.
struct MotiveAcknowledgement {
  EntryPointer<Motive> motive;
  std::string asker;
  AnyEntryPointer cause;
  MotiveReply reply = MotiveReply::accepted;
  /// A sentence.
  std::string words;
  /// Proxies of the things that it is about, as far as they are known: of "one of the balls" the
  /// one that was chosen.
  std::vector<std::string> things = {};
};

/// Nothing is left to be done for a request: told when its last step is done, or when it is given
/// up, but not when people stop it.
struct RequestEnded {
  EntryPointer<communication::DialogueMove> move;
  bool is_done = true;
};

enum class MotiveQuestionKind : std::uint8_t { doing, next, why, why_not, done, whether };
CASTOR_REFLECT_ENUM(MotiveQuestionKind, doing, next, why, why_not, done, whether)

/// A call: what the robot does, will do and has done, whether it has done something, and why it
/// does or does not. Replied to by a MotiveAnswer.
struct MotiveQuestion {
  MotiveQuestionKind kind = MotiveQuestionKind::doing;
  /// Words that the motive that it is about has, all of them, apart by blanks: "blue ball". One of
  /// several by bars will do: "box|cube". Empty for the last motive.
  std::string about;
};

struct MotiveAnswer {
  /// A sentence.
  std::string words;
};

/// Entry: what people have asked for that a generator will make motives of when the one before is
/// over. Its id is `requests_waiting`.
struct RequestsWaiting {
  /// Why, as in Motive: "you said 'give me the ball'"; the next one first.
  std::vector<std::string> because;

  friend bool operator==(const RequestsWaiting&, const RequestsWaiting&) = default;
};

inline constexpr const char* requests_waiting = "requests waiting";

/// How far a generator of motives has got with what people say.
struct RequestsHeard {
  /// The last one.
  std::int32_t turn = -1;
};

CASTOR_REFLECT(RequestsHeard, turn)
CASTOR_REFLECT(RequestsWaiting, because)
CASTOR_REFLECT(MotiveEvent, time, status, why)
CASTOR_REFLECT(Motive, kind, goal, words, because, asker, cause, about, priority, cost, resources,
               patience, status, history)
CASTOR_REFLECT(MotiveAcknowledgement, motive, asker, cause, reply, words, things)
CASTOR_REFLECT(RequestEnded, move, is_done)
CASTOR_REFLECT(MotiveQuestion, kind, about)
CASTOR_REFLECT(MotiveAnswer, words)

} // namespace castor::planning
