#pragma once

namespace avoidbench {

/// What this program was built from and how; version.cpp is made at each build.
extern const char* const kVersion;
extern const char* const kGitHash;  ///< with -dirty where files were changed; "unknown" without git
extern const char* const kCompiler;
extern const char* const kCompilerFlags;

}  // namespace avoidbench
