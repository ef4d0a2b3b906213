// Parts of shbake that are shared libraries of their own, loaded when they are first needed.
#pragma once

#include <string>

namespace shbake {

/// A function of a module, or why there is none. The module stays loaded.
struct ModuleFunction {
  void* address = nullptr;
  std::string problem;
};

/// Loads the module from the first of these places where its file is: beside the program or library that holds this
/// code; in the folder `installed` seen from there ("../lib/shbake"); at `built`, where the build has put it. Paths are
/// absolute, so that neither the working folder nor search paths matter, and an installed shbake can be moved as a
/// whole.
ModuleFunction moduleFunction(const std::string& built, const std::string& installed, const char* function);

}  // namespace shbake
