#pragma once
#include "snapshot.h"

namespace starbow {

/// The picture as a JPEG file's bytes; empty for a picture without pixels or of a wrong size.
std::vector<unsigned char> jpeg_of(const LivePicture& picture);

} // namespace starbow
