#pragma once

namespace ballbot {

/// Makes stdin, stdout and stderr safe to use, whatever the shell gave: to be called first in
/// main(). A closed one can no longer be taken by a file of a run; words on stderr that cannot be
/// delivered (closed, full disk, a reader that went away) are lost and end nothing; a write beyond
/// a file size limit or to a reader that went away fails instead of killing the process.
void prepareStandardStreams();

/// Hands everything printed to the operating system. @throw OutputError if stdout did not take all
void finishStandardOutput();

}  // namespace ballbot
