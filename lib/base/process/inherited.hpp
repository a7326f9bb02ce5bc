#pragma once

/// What a process gets from its parent without asking, and code of others must not have. Nothing
/// here allocates.
namespace avoidbench {

/// Closes every descriptor from `first` on.
void close_from(int first);

/// Lets go of the terminal that this process belongs to: /dev/tty leads nowhere from then on. It
/// stays in its session and group, so that Ctrl-Z and a shell's job control still reach it.
void leave_terminal();

}  // namespace avoidbench
