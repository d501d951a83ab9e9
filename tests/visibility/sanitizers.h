// Embree and its TBB are not instrumented: the thread sanitizer takes their own synchronisation for races.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define RADVOR_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define RADVOR_THREAD_SANITIZER 1
#endif
#endif

#if defined(RADVOR_THREAD_SANITIZER)
#define RADVOR_SKIP_WITHOUT_EMBREE() GTEST_SKIP() << "Embree is not instrumented: not run under the thread sanitizer"
#else
#define RADVOR_SKIP_WITHOUT_EMBREE() (void)0
#endif
