// The floating-point mode that rays are traced in.
#pragma once

namespace shbake {

/// While it lives, this thread flushes denormal numbers to zero, as Embree asks for.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace shbake
