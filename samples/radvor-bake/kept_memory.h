// What the process does with memory that it let go.
#pragma once

namespace bake {

/// glibc gives large blocks back to the system as soon as they are free, and a bake's arrays, which are made anew with
/// every refinement, take them from it again, page by page. A process that bakes and ends keeps them. Elsewhere
/// nothing happens.
void keep_freed_memory();

}  // namespace bake
