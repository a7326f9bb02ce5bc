/* What a planner that is a program and avoidbench say to each other, protocol 1: for programs in C,
 * and for the host. docs/process_planners.md says all of it in words. C99, needs only <stdint.h>.
 *
 * SPDX-License-Identifier: MIT
 * This header may be used in and linked with planners under any licence, closed ones too.
 *
 * Little-endian; every struct begins at a multiple of 8 bytes. In the segment the structs of
 * planner.h have the bytes that they have in C on 64-bit machines, except that each pointer is an
 * offset from the segment's first byte, 0 for null. Texts end with a byte 0.
 */
#ifndef AVOIDBENCH_PROCESS_PROTOCOL_H
#define AVOIDBENCH_PROCESS_PROTOCOL_H

#include <stdint.h>

#define AB_PROCESS_PROTOCOL 1u
#define AB_PROCESS_MAGIC "avoidben" /* 8 bytes, without the 0 */
/* The environment variable "SOCKET,SEGMENT": two file descriptors that the program has. */
#define AB_PROCESS_VARIABLE "AVOIDBENCH_PLANNER_FDS"

/* ab_process_word.kind and so on: what is asked. */
#define AB_PROCESS_HELLO 1u   /* no body; answered by an ab_process_description */
#define AB_PROCESS_CREATE 2u  /* ab_setup */
#define AB_PROCESS_RESET 3u   /* ab_mission */
#define AB_PROCESS_PLAN 4u    /* ab_observation; answered by an ab_command where status is AB_OK */
#define AB_PROCESS_DESTROY 5u /* no body */

/* The segment's first bytes. The host writes them; offsets never change, the size may grow. */
typedef struct ab_process_header {
  char magic[8];
  uint32_t protocol;    /* AB_PROCESS_PROTOCOL of the host */
  uint32_t abi_version; /* AVOIDBENCH_ABI_VERSION of the host */
  uint64_t segment_bytes;
  uint64_t answer_offset;  /* where the program writes its answers … */
  uint64_t answer_bytes;   /* … which are not longer than this */
  uint64_t request_offset; /* where the host writes its requests, up to the segment's end */
  uint64_t reserved[2];
} ab_process_header;

/* What goes through the socket, in both directions: look into the segment. */
typedef struct ab_process_word {
  uint32_t sequence; /* 1, 2, 3, …; that of the request in its answer */
  uint32_t kind;
} ab_process_word;

/* At request_offset. */
typedef struct ab_process_request {
  uint32_t sequence, kind;
  uint64_t bytes; /* from request_offset, this struct included */
  uint64_t body;  /* offset of the struct that the kind says; 0: none */
  uint64_t reserved;
} ab_process_request;

/* At answer_offset. Whatever it points to lies between this struct and the answer's end. */
typedef struct ab_process_answer {
  uint32_t sequence, kind;
  int32_t status; /* ab_status: of planner.h's call; AB_OK or AB_ERROR of the others */
  uint32_t log_count;
  uint64_t bytes; /* from answer_offset, this struct included */
  uint64_t body;
  uint64_t error; /* the text of set_error; 0: none */
  uint64_t log;   /* log_count of ab_process_log; 0: none */
  uint64_t reserved[2];
} ab_process_answer;

typedef struct ab_process_log {
  int32_t level; /* AB_LOG_INFO, AB_LOG_WARNING */
  uint32_t reserved;
  uint64_t text;
} ab_process_log;

typedef struct ab_process_description {
  uint32_t struct_size;
  uint32_t protocol; /* that the program speaks: AB_PROCESS_PROTOCOL */
  uint64_t planner;  /* an ab_planner, its functions 0 */
  uint64_t files;    /* an ab_files; 0: none */
} ab_process_description;

#endif
