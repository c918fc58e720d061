// SPDX-License-Identifier: BSD-3-Clause
// The part of failing_calls.h that takes memory away, and threads.
#include "failing_calls.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unwind.h>

#if defined(__SANITIZE_ADDRESS__)
#define GRANULAR_TEST_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GRANULAR_TEST_ADDRESS_SANITIZER 1
#endif
#endif

namespace
{
std::atomic<long> live = 0;

/// Where the machine code of a program or library begins and ends, and its name.
struct Module
{
  std::uintptr_t begin;
  std::uintptr_t end;
  const char* name; ///< empty: the program
};

/// Calls use for each module until it returns true. Takes no memory.
template <class Use>
void for_each_module(Use use)
{
  const auto look = [](dl_phdr_info* info, std::size_t, void* data)
  {
    Module module = { UINTPTR_MAX, 0, info->dlpi_name };
    for (int i = 0; i < info->dlpi_phnum; ++i)
    {
      const auto& part = info->dlpi_phdr[i];
      if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0)
      {
        module.begin = info->dlpi_addr + part.p_vaddr;
        module.end = module.begin + part.p_memsz;
      }
    }
    return (*static_cast<Use*>(data))(module) ? 1 : 0;
  };
  ::dl_iterate_phdr(look, &use);
}

/// The module of an address that a thread has looked for before, or of this one; without a name if there is none.
Module module_of(std::uintptr_t address)
{
  static thread_local std::array<Module, 16> known = {};
  static thread_local std::size_t next = 0;
  for (const Module& module : known)
  {
    if (module.begin <= address && address < module.end)
    {
      return module;
    }
  }
  Module found = { 0, 0, nullptr };
  for_each_module(
    [&](const Module& module)
    {
      const bool fits = module.begin <= address && address < module.end;
      found = fits ? module : found;
      return fits;
    });
  known[next++ % known.size()] = found;
  return found;
}

/// The loader takes memory for each thread, and keeps it: such memory is not counted.
bool is_of_loader(const void* caller)
{
  static const Module loader = []
  {
    Module found = { 0, 0, nullptr };
    for_each_module(
      [&](const Module& module)
      {
        const bool fits = std::strstr(module.name, "ld-linux") != nullptr;
        found = fits ? module : found;
        return fits;
      });
    return found;
  }();
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  return loader.begin <= address && address < loader.end;
}

/// Libraries that take memory for those who call them.
bool serves_others(const char* name)
{
  for (const char* const part : { "libstdc++", "libc.so", "libz.so", "libzstd", "libgcc_s" })
  {
    if (std::strstr(name, part) != nullptr)
    {
      return true;
    }
  }
  return false;
}

/// Whether the one who needs the memory is who the test asks for; the program has the name "program".
bool is_wanted(const void* caller)
{
  struct Search
  {
    const char* wanted;
    const void* caller;
    bool begun; ///< the frames of this file are passed over
    bool found;
  } search = { failing_calls::wanted_caller(), caller, false, false };
  static thread_local bool inside = false; // looking may take memory
  if (search.wanted == nullptr || inside)
  {
    return !inside;
  }
  inside = true;
  ::_Unwind_Backtrace(
    [](_Unwind_Context* context, void* data)
    {
      auto& state = *static_cast<Search*>(data);
      const std::uintptr_t address = ::_Unwind_GetIP(context);
      state.begun = state.begun || address == reinterpret_cast<std::uintptr_t>(state.caller);
      const char* name = state.begun ? module_of(address).name : nullptr;
      if (name == nullptr || serves_others(name))
      {
        return _URC_NO_REASON;
      }
      state.found = std::strstr(*name == '\0' ? "program" : name, state.wanted) != nullptr;
      return _URC_END_OF_STACK;
    },
    &search);
  inside = false;
  return search.found;
}

/// Whether a caller, who is not the loader, is not to have memory.
bool is_refused(const void* caller)
{
  return failing_calls::may_refuse(calls::memory) && is_wanted(caller) &&
    failing_calls::refuses(calls::memory);
}

/// Memory by take(), counted; null if it is refused.
template <class Take>
void* taken(const void* caller, const Take& take)
{
  if (is_of_loader(caller))
  {
    return take();
  }
  void* const block = is_refused(caller) ? nullptr : take();
  live += block != nullptr ? 1 : 0;
  return block;
}

void give_back(void* block, const void* caller)
{
  live -= block != nullptr && !is_of_loader(caller) ? 1 : 0;
}
}

long live_blocks()
{
  return live;
}

// NOLINTBEGIN: the names and types are those of the system
#pragma GCC visibility push(default) // shared libraries are to find them
#ifdef GRANULAR_TEST_ADDRESS_SANITIZER
// The sanitizer has malloc to itself: only new fails.
namespace
{
void* new_block(std::size_t bytes, std::size_t alignment, const void* caller)
{
  void* block = nullptr;
  return taken(caller,
    [&]
    {
      return alignment == 0                               ? std::malloc(bytes == 0 ? 1 : bytes)
        : ::posix_memalign(&block, alignment, bytes) == 0 ? block
                                                          : nullptr;
    });
}

void* new_or_throw(std::size_t bytes, std::size_t alignment, const void* caller)
{
  void* const block = new_block(bytes, alignment, caller);
  return block != nullptr ? block : throw std::bad_alloc();
}

void delete_block(void* block, const void* caller) noexcept
{
  give_back(block, caller);
  std::free(block);
}
}

// clang-format off
void* operator new(std::size_t n) { return new_or_throw(n, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t n) { return new_or_throw(n, 0, __builtin_return_address(0)); }
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return new_block(n, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept { return new_block(n, 0, __builtin_return_address(0)); }
void* operator new(std::size_t n, std::align_val_t a) { return new_or_throw(n, static_cast<std::size_t>(a), __builtin_return_address(0)); }
void* operator new[](std::size_t n, std::align_val_t a) { return new_or_throw(n, static_cast<std::size_t>(a), __builtin_return_address(0)); }
void* operator new(std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept { return new_block(n, static_cast<std::size_t>(a), __builtin_return_address(0)); }
void* operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept { return new_block(n, static_cast<std::size_t>(a), __builtin_return_address(0)); }
void operator delete(void* p) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete[](void* p) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete(void* p, std::size_t) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete[](void* p, std::size_t) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete(void* p, std::align_val_t) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete[](void* p, std::align_val_t) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { delete_block(p, __builtin_return_address(0)); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { delete_block(p, __builtin_return_address(0)); }
// clang-format on
#else
extern "C"
{
  void* __libc_malloc(size_t bytes);
  void* __libc_calloc(size_t count, size_t bytes);
  void* __libc_realloc(void* block, size_t bytes);
  void* __libc_memalign(size_t alignment, size_t bytes);
  void __libc_free(void* block);

  void* malloc(size_t bytes) noexcept
  {
    return taken(__builtin_return_address(0), [&] { return __libc_malloc(bytes); });
  }

  void* calloc(size_t count, size_t bytes) noexcept
  {
    return taken(__builtin_return_address(0), [&] { return __libc_calloc(count, bytes); });
  }

  void* realloc(void* block, size_t bytes) noexcept
  {
    const void* const caller = __builtin_return_address(0);
    if (block == nullptr)
    {
      return taken(caller, [&] { return __libc_realloc(nullptr, bytes); });
    }
    if (bytes == 0)
    {
      give_back(block, caller);
      return __libc_realloc(block, 0);
    }
    return !is_of_loader(caller) && is_refused(caller) ? nullptr : __libc_realloc(block, bytes);
  }

  int posix_memalign(void** block, size_t alignment, size_t bytes) noexcept
  {
    void* const found =
      taken(__builtin_return_address(0), [&] { return __libc_memalign(alignment, bytes); });
    *block = found != nullptr ? found : *block;
    return found != nullptr ? 0 : ENOMEM;
  }

  void* aligned_alloc(size_t alignment, size_t bytes) noexcept
  {
    return taken(__builtin_return_address(0), [&] { return __libc_memalign(alignment, bytes); });
  }

  void* memalign(size_t alignment, size_t bytes) noexcept
  {
    return taken(__builtin_return_address(0), [&] { return __libc_memalign(alignment, bytes); });
  }

  void free(void* block) noexcept
  {
    give_back(block, __builtin_return_address(0));
    __libc_free(block);
  }
}
#endif

extern "C"
{
  long granular_live_blocks()
  {
    return live;
  }

  void* mmap(void* where, size_t bytes, int access, int flags, int file, off_t offset) noexcept
  {
    static auto* const call =
      reinterpret_cast<void* (*)(void*, size_t, int, int, int, off_t)>(::dlsym(RTLD_NEXT, "mmap"));
    const bool of_memory = (flags & MAP_ANONYMOUS) != 0;
    return of_memory && is_wanted(__builtin_return_address(0)) && failing_calls::refuses(calls::map)
      ? MAP_FAILED
      : call(where, bytes, access, flags, file, offset);
  }

  int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*begin)(void*),
    void* argument) noexcept
  {
    static auto* const call =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
    return failing_calls::refuses(calls::thread) ? EAGAIN
                                                 : call(thread, attributes, begin, argument);
  }
}
#pragma GCC visibility pop
// NOLINTEND
