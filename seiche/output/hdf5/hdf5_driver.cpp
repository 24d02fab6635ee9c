#include <seiche/output/file/folder_open.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>
#include <seiche/output/hdf5/hdf5_driver.hpp>

#include <fcntl.h>
#include <hdf5.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace seiche {
namespace {

struct Access {
  int file;
};

struct Piece {
  H5FD_mem_t kind;
  std::string bytes;
};

// In this order, each beginning of which leaves a whole file.
int rank(const Piece& piece) {
  switch (piece.kind) {
    case H5FD_MEM_SUPER: return 0;
    case H5FD_MEM_BTREE: return 1;
    case H5FD_MEM_GHEAP: return 2;
    case H5FD_MEM_LHEAP: return 3;
    default: return 4;
  }
}

// Of the index of chunks ("TREE", kind, level): a full node gives half of its entries to a new one, which its parent
// has to know before they go. 0 for anything else.
int level(const Piece& piece) {
  constexpr std::size_t at = 5;
  return piece.bytes.size() > at && piece.bytes.starts_with("TREE") ? static_cast<unsigned char>(piece.bytes[at]) : 0;
}

class OrderedFile : public H5FD_t {
 public:
  OrderedFile(int file, bool empty) : H5FD_t(), file_(file), identity_(file) {
    if (empty && ::ftruncate(file_, 0) != 0) failure_ = errno;
    struct stat status = {};
    if (::fstat(file_, &status) == 0) size_ = settled_ = static_cast<haddr_t>(status.st_size);
  }
  ~OrderedFile() { ::close(file_); }
  OrderedFile(const OrderedFile&) = delete;
  OrderedFile& operator=(const OrderedFile&) = delete;

  static OrderedFile& of(H5FD_t* file) { return *static_cast<OrderedFile*>(file); }
  static const OrderedFile& of(const H5FD_t* file) { return *static_cast<const OrderedFile*>(file); }

  haddr_t end() const { return end_; }
  // What is behind the new end is of no use to HDF5 any more, and the room may get another use.
  void set_end(haddr_t end) {
    end_ = end;
    held_.erase(held_.lower_bound(end), held_.end());
    for (auto& [address, piece] : held_) piece.bytes.resize(std::min<haddr_t>(piece.bytes.size(), end - address));
  }
  haddr_t size() const { return std::max(size_, end_of_held()); }
  const FileIdentity& identity() const { return identity_; }

  // Data that were not written must not be taken for damaged ones.
  bool read(H5FD_mem_t kind, haddr_t at, char* to, std::size_t count) const {
    if (failure_ != 0 && kind == H5FD_MEM_DRAW) return said(failure_, "write");
    std::memset(to, 0, count);  // behind the end of the file
    for (std::size_t done = 0; done < count;) {
      const ::ssize_t size = ::pread(file_, to + done, count - done, static_cast<::off_t>(at + done));
      if (size == 0) break;
      if (size < 0 && errno != EINTR) return said(errno, "read");
      done += size < 0 ? 0 : static_cast<std::size_t>(size);
    }
    for (const auto& [address, piece] : held_) overlay(address, piece.bytes, at, to, count);
    return true;
  }

  bool write(H5FD_mem_t kind, haddr_t at, const char* from, std::size_t count) {
    changed_ = true;
    // Rows of t, H and uncompressed chunks are written again with the same bytes before the new ones.
    // A new file is not an HDF5 file before everything that it begins with is in it.
    const bool is_harmless = (at >= settled_ && kind != H5FD_MEM_SUPER) || kind == H5FD_MEM_DRAW;
    if (!is_harmless || failure_ != 0) {
      if (kind != H5FD_MEM_DRAW) hold(kind, at, {from, count});
      return true;
    }
    if (put(at, from, count)) {
      overlay_held(at, {from, count});
      return true;
    }
    // Nothing counts what is behind: let others have the room.
    if (::ftruncate(file_, static_cast<::off_t>(settled_)) == 0) size_ = settled_;
    return said(failure_, "write");
  }

  // Nothing more is written: what should have been held is lost.
  bool fail(int reason, const char* what) {
    if (failure_ == 0) failure_ = reason;
    return said(failure_, what);
  }

  // What was held back is in the file, or as much of it as leaves it whole. HDF5 may have met the failure where it
  // reports none: a flush does; closing goes on, so that nothing of HDF5 is left open.
  bool settle(bool closing) {
    if (failure_ != 0) return closing || said(failure_, "write");
    if (!changed_) return true;
    if (size_ < end_ && !resize()) return said(failure_, "extend");
    std::vector<std::pair<haddr_t, const Piece*>> order;
    for (const auto& [address, piece] : held_) order.emplace_back(address, &piece);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      return std::tuple(rank(*a.second), -level(*a.second), b.first) <
             std::tuple(rank(*b.second), -level(*b.second), a.first);
    });
    const auto put_all = [&] {
      return std::all_of(order.begin(), order.end(), [this](const auto& one) {
        return put(one.first, one.second->bytes.data(), one.second->bytes.size());
      });
    };
    if (!put_all()) {
      const int reason = failure_;
      put_all();  // what failed once may not fail again, and the rest belongs to it
      failure_ = reason;
      return said(failure_, "write");
    }
    held_.clear();
    if (size_ > end_) resize();  // what is told to be shorter may be longer
    settled_ = end_;
    return true;
  }

 private:
  static void overlay(haddr_t address, std::string_view bytes, haddr_t at, char* to, std::size_t count) {
    const haddr_t begin = std::max(address, at), finish = std::min(address + bytes.size(), at + count);
    if (begin < finish) std::memcpy(to + (begin - at), bytes.data() + (begin - address), finish - begin);
  }

  // What is held agrees with what was written last, in whatever order its pieces are written.
  void overlay_held(haddr_t at, std::string_view bytes) {
    for (auto& [address, piece] : held_) overlay(at, bytes, address, piece.bytes.data(), piece.bytes.size());
  }

  void hold(H5FD_mem_t kind, haddr_t at, const std::string& bytes) {
    overlay_held(at, bytes);
    Piece& piece = held_[at];
    piece.kind = kind;
    if (piece.bytes.size() <= bytes.size()) piece.bytes = bytes;
  }

  bool put(haddr_t at, const char* from, std::size_t count) {
    for (std::size_t done = 0; done < count;) {
      const ::ssize_t size = ::pwrite(file_, from + done, count - done, static_cast<::off_t>(at + done));
      if (size == 0 || (size < 0 && errno != EINTR)) {
        failure_ = size == 0 ? ENOSPC : errno;  // nothing was written, and nothing would be if it were tried again
        return false;
      }
      done += size < 0 ? 0 : static_cast<std::size_t>(size);
    }
    size_ = std::max(size_, at + count);
    return true;
  }

  bool resize() {
    if (::ftruncate(file_, static_cast<::off_t>(end_)) != 0) {
      failure_ = errno;
      return false;
    }
    size_ = end_;
    return true;
  }

  haddr_t end_of_held() const {
    haddr_t end = 0;
    for (const auto& [address, piece] : held_) end = std::max(end, address + piece.bytes.size());
    return end;
  }

  // In the words of HDF5's own drivers.
  static bool said(int reason, const char* what) {
    H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_WRITEERROR,
             "file %s failed: errno = %d, error message = '%s'", what, reason, std::strerror(reason));
    return false;
  }

  int file_;
  FileIdentity identity_;
  haddr_t end_ = 0;      // of what HDF5 has given out
  haddr_t size_ = 0;     // of the file
  haddr_t settled_ = 0;  // the end at the last flush
  std::map<haddr_t, Piece> held_;
  bool changed_ = false;
  int failure_ = 0;
};

// HDF5 is C, through which no exception may pass; std::bad_alloc is one to be expected.
template <class Call>
herr_t guarded(OrderedFile& file, const char* what, Call call) noexcept {
  try {
    return call() ? 0 : -1;
  } catch (...) {
    return file.fail(ENOMEM, what) ? 0 : -1;
  }
}

H5FD_t* open(const char*, unsigned flags, hid_t access, haddr_t) {
  const auto* given = static_cast<const Access*>(H5Pget_driver_info(access));
  const int file = given != nullptr ? ::fcntl(given->file, F_DUPFD_CLOEXEC, 0) : -1;
  if (file < 0) return nullptr;
  // Others may read meanwhile, and none may write; file systems without locks are not locked.
  ::flock(file, LOCK_SH | LOCK_NB);
  H5FD_t* const opened = new (std::nothrow) OrderedFile(file, (flags & H5F_ACC_TRUNC) != 0);
  if (opened == nullptr) ::close(file);
  return opened;
}

herr_t close(H5FD_t* file) {
  const std::unique_ptr<OrderedFile> ours(&OrderedFile::of(file));
  return guarded(*ours, "close", [&] { return ours->settle(true); });
}

herr_t read(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t at, std::size_t count, void* to) {
  OrderedFile& ours = OrderedFile::of(file);
  return guarded(ours, "read", [&] { return ours.read(kind, at, static_cast<char*>(to), count); });
}

herr_t write(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t at, std::size_t count, const void* from) {
  OrderedFile& ours = OrderedFile::of(file);
  return guarded(ours, "write", [&] { return ours.write(kind, at, static_cast<const char*>(from), count); });
}

herr_t flush(H5FD_t* file, hid_t, hbool_t closing) {
  OrderedFile& ours = OrderedFile::of(file);
  return guarded(ours, "write", [&] { return ours.settle(closing); });
}

herr_t set_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  OrderedFile& ours = OrderedFile::of(file);
  return guarded(ours, "extend", [&] {
    ours.set_end(end);
    return true;
  });
}

haddr_t end(const H5FD_t* file, H5FD_mem_t) { return OrderedFile::of(file).end(); }
haddr_t size(const H5FD_t* file, H5FD_mem_t) { return OrderedFile::of(file).size(); }

int compare(const H5FD_t* a, const H5FD_t* b) {
  const FileIdentity &first = OrderedFile::of(a).identity(), &second = OrderedFile::of(b).identity();
  if (first == second) return 0;
  return std::tie(first.device, first.number) < std::tie(second.device, second.number) ? -1 : 1;
}

herr_t query(const H5FD_t*, unsigned long* features) {
  // Not the accumulator of metadata, which would write several things as one.
  if (features != nullptr) *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

hid_t ordered_driver() {
  static const hid_t id = [] {
    H5FD_class_t driver = {};
#if H5_VERSION_GE(1, 13, 0)
    driver.version = H5FD_CLASS_VERSION;
    driver.value = 400;  // 256 to 511 are free for trials; from 512 on the HDF Group gives them out
#endif
    driver.name = "ordered";
    driver.maxaddr = HADDR_MAX;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(Access);
    driver.open = open;
    driver.close = close;
    driver.cmp = compare;
    driver.query = query;
    driver.get_eoa = end;
    driver.set_eoa = set_end;
    driver.get_eof = size;
    driver.read = read;
    driver.write = write;
    driver.flush = flush;
    const H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
    return H5FDregister(&driver);
  }();
  return id;
}

}  // namespace

Hdf5Handle ordered_file_access(int file) {
  const Hdf5Quiet quiet;
  Hdf5Handle list = hdf5_handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "HDF5 does not work");
  const Access access{file};
  hdf5_check(H5Pset_driver(list.id(), ordered_driver(), &access), "HDF5 does not take our driver");
  return list;
}

}  // namespace seiche
