#pragma once

#include "castor/wm/entries/address.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

/// Errors of operations on working memory: values between actors (`Failure`, `Outcome`), the
/// paper's exceptions in the interface for components.
namespace castor {

enum class FailureKind : std::uint8_t {
  does_not_exist,
  already_exists,
  inconsistent,
  not_permitted,
  unknown_subarchitecture,
  wrong_type,
  no_answer,
  working_memory_lost,
  leased,
  lease_lost,
  deadlock,
  bad_address,
  too_large,
  bad_predicate,
  not_atomic,
  call_failed,
};

struct Failure {
  FailureKind kind = FailureKind::no_answer;
  /// Names the entry, both sides, and the remedy.
  std::string message;
  /// The entry concerned; the id is empty for a whole working memory.
  Address address;
};

/// Either a result or a failure.
template <class T>
class Outcome {
public:
  Outcome() = default;
  Outcome(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Outcome(Failure failure) : content_(std::in_place_index<1>, std::move(failure)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& operator*() const& { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  const T* operator->() const { return &std::get<0>(content_); }
  const Failure& failure() const { return std::get<1>(content_); }

private:
  std::variant<T, Failure> content_;
};

/// Base of all exceptions of operations on working memory.
class WorkingMemoryException : public std::runtime_error {
public:
  explicit WorkingMemoryException(Failure failure)
    : runtime_error(failure.message), failure_(std::move(failure)) {}

  FailureKind kind() const { return failure_.kind; }
  const Address& address() const { return failure_.address; }

private:
  Failure failure_;
};

/// There is no entry at the address.
class DoesNotExistOnWM : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// There is an entry at the address already.
class AlreadyExistsOnWM : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The entry was changed since the component last read or wrote it, or the component never read it.
class ConsistencyException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The component's subarchitecture may not write to that working memory, or another component holds
/// a lease of the entry that forbids it.
class PermissionException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// No subarchitecture of that name.
class UnknownSubarchitectureException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The entry's type is not the requested one, or not that of the value to overwrite it with.
class TypeMismatchException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// No answer within the component's deadline.
class DeadlineException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The working memory ended while the operation was under way, or before.
class WorkingMemoryLostException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The component no longer holds the lease that it writes under or releases.
class LeaseLostException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The component waited for another one that waited for it, directly or indirectly.
class DeadlockException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// An address without an id or without a subarchitecture.
class BadAddressException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The value is larger than the working memory accepts.
class EntryTooLargeException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// A condition does not fit the type of the entries.
class PredicateException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// An atomic write concerns several working memories, or an entry twice.
class NotAtomicException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// The component that served a call failed or ended.
class CallException : public WorkingMemoryException {
  using WorkingMemoryException::WorkingMemoryException;
};

/// Throws the exception for the failure's kind.
[[noreturn]] void throw_failure(const Failure& failure);

/// Returns the result, or throws its failure.
template <class T>
T value_or_throw(Outcome<T> outcome) {
  if (!outcome)
    throw_failure(outcome.failure());
  return *std::move(outcome);
}

} // namespace castor
