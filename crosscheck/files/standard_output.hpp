#pragma once

namespace lockstep {

/// The program's alone, early in main. No text that cannot be written ends a run before its files are there: the reason
/// is kept for finish_standard_output. Where nobody reads any more and no file was expected (OutputFiles), the program
/// ends as any other does, by SIGPIPE. Standard streams that are closed are opened, so that no file gets their number.
void own_standard_output();

/// Throws Error if something could not be written.
void finish_standard_output();

} // namespace lockstep
