#pragma once

#include <string>

#include <sys/types.h>

/// The children of this process, each with a process group of its own, and all that they start:
/// what a component forks must not outlive it.
namespace castor::cli {

/// A setting for the environment of one child, "CASTOR_CHILD=...", by which its descendants are
/// found, also those that have left its process group.
std::string new_child_mark();

/// This child has been started, with this mark in its environment.
void add_child(pid_t child, const std::string& mark);

/// Kills a child, if it has not ended, and all its descendants. Waits for its end, and returns what
/// waitpid() says of that.
int end_child(pid_t child);

/// Kills all children that were added and their descendants, and waits for nobody.
void kill_children();

/// In a child: kills all other processes with its mark.
void kill_own_descendants();

} // namespace castor::cli
