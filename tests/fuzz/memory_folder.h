#pragma once

namespace cellcrush::fuzz {

/// Has temporary folders made where writes are not waited for, if there is such a place: what a run makes durable is of
/// no worth.
void use_memory_folder();

}  // namespace cellcrush::fuzz
