// What the names of files say.
#pragma once

#include <string>

namespace shbake {

/// The extension of a path in lower case, with its dot; empty where it has none: "Room.OBJ" gives ".obj".
std::string lowerExtension(const std::string& path);

}  // namespace shbake
