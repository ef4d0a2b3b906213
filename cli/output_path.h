// Names of outputs that cannot be meant, refused before any work is done.
#pragma once

#include <span>
#include <string>

namespace shbake::cli {

/// Throws a usage error when `output` is one of the files `inputs`, unless `force`; "would replace" + `what` is said:
/// "the mesh that is refined". Then throws what opening it for writing would throw.
void checkOutput(const std::string& output, std::span<const std::string> inputs, const std::string& what, bool force);

/// Throws a usage error when the name of an output that `verb` writes as PLY has another extension. None is well.
void requirePlyName(const std::string& output, const std::string& verb);

}  // namespace shbake::cli
