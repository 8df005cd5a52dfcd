#pragma once

#include <string>

#include <sys/types.h>

/// The children of this process, each with a process group of its own, and their descendants: a
/// process forked by a component must not outlive it.
namespace castor::cli {

/// An environment variable for one child, "CASTOR_CHILD=...", to find its descendants, including
/// those that have left its process group.
std::string new_child_mark();

/// Registers a child that has been started with this mark in its environment.
void add_child(pid_t child, const std::string& mark);

/// Kills a child, if it has not ended, and all its descendants. Waits for its end, and returns its
/// status from waitpid().
int end_child(pid_t child);

/// Kills all registered children and their descendants, without waiting.
void kill_children();

/// In a child: kills all other processes with its mark.
void kill_own_descendants();

} // namespace castor::cli
