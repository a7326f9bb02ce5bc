/* Attacks as soon as its library is loaded, or taken out again, by the statement that HOSTILE_LOAD
 * or HOSTILE_UNLOAD is. */
#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "hostile.h"

#ifndef HOSTILE_USES
#define HOSTILE_USES 0u
#endif
const uint32_t kHostileUses = HOSTILE_USES;

#ifdef HOSTILE_LOAD
__attribute__((constructor)) static void load(void) { HOSTILE_LOAD; }
#endif
#ifdef HOSTILE_UNLOAD
__attribute__((destructor)) static void unload(void) { HOSTILE_UNLOAD; }
#endif
