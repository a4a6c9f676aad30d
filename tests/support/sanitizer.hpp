// Whether this build has a sanitizer that keeps books of memory, and needs far more of it than the program: limits of memory end it.
#pragma once

namespace slideway::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool memory_is_watched = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool memory_is_watched = true;
#else
inline constexpr bool memory_is_watched = false;
#endif
#else
inline constexpr bool memory_is_watched = false;
#endif

}  // namespace slideway::testing
