// Finding and loading modules by the dynamic linker.
#include "base/module.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>

namespace shbake {
namespace {

namespace fs = std::filesystem;

/// The folder of the program or shared library that this code is linked to; empty where the system does not tell.
fs::path ownFolder() {
  static const char kHere = 0;
  Dl_info info{};
  link_map* map = nullptr;
  if (::dladdr1(&kHere, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) == 0 || map == nullptr) return {};
  // The program itself has no name there, and what it was called by may be relative to another folder.
  const fs::path file = map->l_name[0] == '\0' ? fs::path("/proc/self/exe") : fs::path(map->l_name);
  std::error_code none;
  return fs::canonical(file, none).parent_path();
}

std::string pathOfModule(const fs::path& built, const fs::path& installed) {
  const fs::path own = ownFolder();
  std::error_code none;
  if (!own.empty()) {
    for (const fs::path& folder : {own, own / installed}) {
      const fs::path candidate = (folder / built.filename()).lexically_normal();
      if (fs::exists(candidate, none)) return candidate.string();
    }
  }
  return built.string();
}

}  // namespace

ModuleFunction moduleFunction(const std::string& built, const std::string& installed, const char* function) {
  ModuleFunction result;
  // By its full path: a search along the program's run path does not work under the address sanitizer, whose own dlopen
  // is then the caller.
  void* const module = ::dlopen(pathOfModule(built, installed).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module != nullptr) result.address = ::dlsym(module, function);
  if (result.address == nullptr) {
    const char* const reason = ::dlerror();
    result.problem = reason != nullptr ? reason : "no reason is told";
  }
  return result;
}

}  // namespace shbake
