// An array of lane types. std::vector is no place for them: its functions are compiled for the least instruction set,
// where GCC 12 knows neither the alignment nor the registers of wider vectors.
#if defined(POSED_SPRINGS_MEMORY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef POSED_SPRINGS_MEMORY_INL_H_
#undef POSED_SPRINGS_MEMORY_INL_H_
#else
#define POSED_SPRINGS_MEMORY_INL_H_
#endif

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace posed::springs::HWY_NAMESPACE {

// Of trivial types.
template <class T>
class Memory {
 public:
  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  // All bytes 0. Allocates only where it grows.
  void resize(std::size_t size) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (size > capacity_) {
      bytes_ = hwy::AllocateAligned<unsigned char>(size * sizeof(T));
      capacity_ = size;
    }
    size_ = size;
    if (size > 0) std::memset(bytes_.get(), 0, size * sizeof(T));
  }
  // Room for so many, to be filled by add.
  void reserve(std::size_t size) {
    resize(size);
    size_ = 0;
  }
  HWY_INLINE T& add() { return data()[size_++]; }
  HWY_INLINE void clear() { size_ = 0; }
  HWY_INLINE void swap(Memory& other) {
    bytes_.swap(other.bytes_);
    std::swap(capacity_, other.capacity_);
    std::swap(size_, other.size_);
  }

  HWY_INLINE std::size_t size() const { return size_; }
  HWY_INLINE bool empty() const { return size_ == 0; }
  HWY_INLINE T* data() { return reinterpret_cast<T*>(bytes_.get()); }
  HWY_INLINE const T* data() const { return reinterpret_cast<const T*>(bytes_.get()); }
  HWY_INLINE T& operator[](std::size_t i) { return data()[i]; }
  HWY_INLINE const T& operator[](std::size_t i) const { return data()[i]; }
  HWY_INLINE T* begin() { return data(); }
  HWY_INLINE T* end() { return data() + size_; }
  HWY_INLINE const T* begin() const { return data(); }
  HWY_INLINE const T* end() const { return data() + size_; }

 private:
  hwy::AlignedFreeUniquePtr<unsigned char[]> bytes_;
  std::size_t capacity_ = 0, size_ = 0;
};

}  // namespace posed::springs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
