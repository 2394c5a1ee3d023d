// A disk with so much room and no more, for one program: loaded into it before all else (LD_PRELOAD).
//
// FULL_DISK names a folder, and FULL_DISK_SIZE a file with the bytes that all files in the folder may have together; where
// there is no such file, there is room for all. What would make a file longer than there is room for fails as the kernel
// has it fail on a full disk; a file that is only said to be longer (ftruncate) takes no room there either. What lies in a file already can be written over, and what is deleted makes room.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static long long used(const char *folder) {
  DIR *open = opendir(folder);
  long long sum = 0;
  for (struct dirent *entry; open && (entry = readdir(open));) {
    char path[PATH_MAX];
    struct stat file;
    snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    if (entry->d_type == DT_REG && stat(path, &file) == 0) sum += file.st_size;
  }
  if (open) closedir(open);
  return sum;
}

// Whether a file may be so long.
static int has_room(int file, long long length) {
  const char *folder = getenv("FULL_DISK"), *size = getenv("FULL_DISK_SIZE");
  char name[64], path[PATH_MAX];
  struct stat now;
  if (!folder || !size || fstat(file, &now) != 0 || !S_ISREG(now.st_mode) || length <= now.st_size) return 1;
  snprintf(name, sizeof name, "/proc/self/fd/%d", file);
  ssize_t end = readlink(name, path, sizeof path - 1);
  if (end < 0) return 1;
  path[end] = 0;
  size_t prefix = strlen(folder);
  if (strncmp(path, folder, prefix) != 0 || path[prefix] != '/') return 1;
  FILE *said = fopen(size, "r");
  long long most = -1;
  if (said) {
    if (fscanf(said, "%lld", &most) != 1) most = -1;
    fclose(said);
  }
  if (most < 0 || used(folder) + length - now.st_size <= most) return 1;
  errno = ENOSPC;
  return 0;
}

static long long place(int file) {
  return lseek(file, 0, SEEK_CUR);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void *bytes, size_t count) {
  return has_room(file, place(file) + (long long)count) ? REAL(write)(file, bytes, count) : -1;
}

ssize_t pwrite(int file, const void *bytes, size_t count, off_t at) {
  return has_room(file, at + (long long)count) ? REAL(pwrite)(file, bytes, count, at) : -1;
}

ssize_t pwrite64(int file, const void *bytes, size_t count, off64_t at) {
  return has_room(file, at + (long long)count) ? REAL(pwrite64)(file, bytes, count, at) : -1;
}
