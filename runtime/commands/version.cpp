// Alone knows the build's definitions, so that all other commands are compiled with the same flags.
#include "version.h"

namespace starbow {

const char* const program_version = STARBOW_VERSION;
const char* const build_type = STARBOW_BUILD_TYPE;

} // namespace starbow
