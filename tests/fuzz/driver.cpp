// A fuzzer (LLVM's libFuzzer) for one reader, SCREE_READER.

#include "fuzz/readers.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scree::test::SCREE_READER({reinterpret_cast<const char*>(data), size});
  return 0;
}
