#pragma once

/// Names of the types that components are written against, for headers that need no more of them.
namespace castor {

struct Address;
struct ChangeEvent;
struct ChangeFilter;
struct Entry;
struct Failure;
struct TypeDescriptor;
class Predicate;
class Value;

class CallbackComponent;
class Component;
class LockGuard;
class ManagedComponent;
class StandaloneComponent;
class SubarchitectureComponent;
class TaskManager;
class UnmanagedComponent;
class WriteBatch;

} // namespace castor
