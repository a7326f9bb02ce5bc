"""What is expected of each way of tests/sweep/hostile: for hostile_runs.py."""

import dataclasses

# Kinds: the flight is as without the attack; it fails, and the row says how; either; another flight is as
# good; the run as a whole ends with a message.
HONEST, FAILS, ANY, OWN, ENDS = "honest", "fails", "any", "own", "ends"


@dataclasses.dataclass(frozen=True)
class Expectation:
    kind: str
    message: str = ""  # FAILS: pattern of "outcome: reason"; ENDS: of what stands on the standard error
    limit: str = "call"  # what ends it: the limit of a call, of a trial, or that of a library's loading ("load")
    codes: tuple = (0,)  # of the program
    flies: bool = True  # there is a database after it


def honest(*names):
    return {name: Expectation(HONEST) for name in names}


def either(*names, **more):
    return {name: Expectation(ANY, **more) for name in names}


def fails(message, *names, **more):
    return {name: Expectation(FAILS, message, **more) for name in names}


CRASHED, HUNG, ERROR = "^planner_crashed: ", "^planner_hung: ", "^planner_error: "

MEMORY = (
    # Filling memory may take longer than a call may: some machines get theirs page by page.
    fails(f"({CRASHED}.*(memory|signal)|{HUNG})", "fill_heap", "map_terabyte")
    | fails("^planner_(crashed|hung)", "fill_children")
    | either("fill_memfd", "fill_shared_memory", "lock_memory", "write_observation", "write_later", "unmap_itself")
    | fails(CRASHED + ".*signal 11", "overflow_stack", "write_null", "call_null", "unmap_stack")
    | fails(CRASHED + ".*signal 6", "free_twice", "break_heap")
    | fails(CRASHED + ".*signal", "write_code")
)

SIGNALS = (
    fails(
        CRASHED + ".*signal",
        "raise_segv",
        "raise_bus",
        "raise_fpe",
        "raise_ill",
        "raise_trap",
        "raise_xcpu",
        "raise_sys",
        "raise_abort",
        "raise_quit",
        "raise_alarm",
        "raise_realtime",
        "crash_ignored",
        "ring_later",
        "overflow_without_stack",
        "jump_into_past",
        "trap_floats",
    )
    | {name: Expectation(ANY) for name in ("jump_into_past", "trap_floats", "ring_later")}
    | honest("raise_pipe", "raise_term", "raise_interrupt", "leave_signals_blocked", "interrupt_often")
    | honest("raise_kill", "raise_stop")
    | either("raise_hangup", "end_by_term", "end_by_timer", "end_by_pipe")
    | fails(HUNG, "hold_watchdog", "cancel_watchdog", "hold_watchdog_and_beat", limit="trial")
    | fails(HUNG, "crash_handled", "block_signals")
    | fails(CRASHED + ".*exit code 0", "crash_as_success")
)

# Where the planner says that it uses processes; else the sandbox lets it have none, and nothing comes of these.
FORKS = (
    either(
        "fork_and_return",
        "fork_and_fail_to_exec",
        "fork_at_create",
        "fork_at_reset",
        "let_the_child_answer",
        "fork_two_hundred",
        "fork_chain",
        "leave_daemon",
        "leave_child_that_writes",
        "leave_child_that_spins",
        "leave_child_that_ignores",
        "leave_child_stopped",
        "leave_child_that_returns",
        "leave_sibling",
        "leave_sibling_that_exits",
        "leave_process_in_same_memory",
        "become_reaper",
        "unshare_all",
        "run_again",
        "leave_server",
    )
    | fails(CRASHED, "leave_child_with_pipes", "leave_daemon_with_pipes", "become_true")
    | fails("^planner_(hung|crashed): ", "become_sleep", limit="trial")
    | fails(CRASHED + ".*memory", "fill_children")
)

PROCESSES = (
    {
        name: dataclasses.replace(FORKS[name], kind=HONEST)
        for name in FORKS
        if name not in ("run_again", "fill_children", "leave_server")
    }
    | fails(CRASHED, "leave_child_with_pipes", "leave_daemon_with_pipes")
    | either("run_again", "start_thread_that_crashes", "start_five_hundred_threads")
    | fails("^planner_(hung|crashed): ", "exit_thread", limit="trial")
    | honest("leave_session", "leave_group", "hide", "start_threads_that_spin")
)

PARENT = honest(
    "interrupt_parent",
    "terminate_parent",
    "warn_parent",
    "kill_parent",
    "stop_parent",
    "kill_everyone",
    "kill_siblings",
    "stop_siblings",
    "crash_siblings",
    "kill_parent_by_descriptor",
    "kill_parent_otherwise",
    "kill_parent_by_pipe",
    "trace_parent",
    "write_parent_memory",
    "write_parent_memory_by_call",
    "limit_parents_files",
    "limit_parents_descriptors",
    "limit_parents_time",
    "slow_parent",
    "offer_parent_to_the_kernel",
    "write_parents_files",
    "steal_parents_files",
    "write_siblings_pipes",
    "read_parent_memory",
    "interrupt_group",
    "kill_group",
)

TERMINAL_WAYS = honest(
    "type_into_terminal",
    "take_terminal",
    "hang_up_terminal",
    "write_to_terminal",
    "change_terminal",
    "freeze_terminal",
    "read_terminal",
)

DESCRIPTORS = (
    fails(
        CRASHED,
        "close_pipes",
        "close_and_open",
        "cover_pipes",
        "write_everywhere",
        "write_a_byte",
        "flood_pipes",
        "cover_with_full_pipe",
        "exchange_pipes",
    )
    | either(
        "close_all",
        "close_all_at_create",
        "flood_notes",
        "read_jobs",
        "use_up_descriptors",
        "do_not_wait",
        "flood_errors",
        limit="trial",
    )
    | honest("shrink_pipes", "print_results", "flood_log", "write_inherited")
)

FILES = honest(
    "overwrite_database",
    "truncate_database",
    "truncate_log",
    "remove_database",
    "remove_log",
    "remove_index",
    "rename_database",
    "replace_database",
    "forbid_database",
    "forbid_folder",
    "update_rows",
    "delete_rows",
    "leave_trigger",
    "keep_write_lock",
    "keep_read_lock",
    "lock_files",
    "lock_files_for_writing",
    "remove_sweep",
    "change_itself",
    "change_good_planner",
    "remove_itself",
    "remove_good_planner",
    "replace_good_planner",
    "leave_files",
    "leave_others",
    "fill_disk",
    "fill_disk_unnamed",
    "write_by_ring",
    "make_immutable",
    "call_newer_kernels",
    "leave_shared_objects",
    "mount_over",
)

RESULTS = either(
    "forge_result",
    "forge_result_and_exit",
    "forge_result_and_hang",
    "forge_three_results",
    "forge_result_at_create",
    "forge_nan",
    "forge_null",
    "forge_empty",
    "forge_list",
    "forge_text",
    "forge_half",
    "forge_kinds",
    "forge_outcome",
    "forge_map",
    "forge_error",
    "forge_out_of_memory",
    "forge_nothing",
    "forge_depth",
    "send_half_a_header",
    "send_half_a_header_and_go_on",
    "send_header_only",
    "send_huge_header",
    "send_endless_header",
    "send_for_ever",
    "send_much",
) | either("stop_in_a_message", limit="trial")

TIMES = (
    fails(HUNG, "spin", "spin_at_reset", "spin_at_create", "sleep_in_call", "wait_for_itself")
    | either("sleep_in_each_call", limit="trial")
    | honest(
        "spin_at_destroy", "hang_at_exit", "leave_at_exit", "abort_at_exit", "limit_files", "limit_stack", "move_clock"
    )
    | fails(CRASHED + ".*exit code 0", "exit_well", "exit_at_create", "exit_at_reset", "exit_at_once", "exit_quickly")
    | fails(CRASHED + ".*exit code 75", "exit_as_stopped")
    | either("exit_as_hung", "limit_descriptors", "limit_memory")
    | fails("^planner_(hung|crashed): ", "hang_at_exit_now", "limit_time")
    | fails(CRASHED + ".*signal 6", "dump_core")
)

ENVIRONMENT = (
    honest(
        "write_commas",
        "round_up",
        "round_up_at_create",
        "flush_to_zero",
        "flush_to_zero_at_reset",
        "round_x87",
        "leave_mmx",
        "change_folder",
        "change_root",
        "open_mask",
        "close_mask",
        "set_variables",
        "clear_variables",
        "seed_draws",
        "hurry",
        "dawdle",
        "load_good_planner",
        "listen_on_port",
        "leave_socket",
        "send_datagram",
        "watch_folder",
    )
    | either("run_backward", "check_alignment", "change_personality", "unload_itself", "leave_server", "call_nobody")
    | fails(ERROR, "write_commas_and_fail")
)

COMMANDS = (
    fails(
        ERROR,
        "give_nan",
        "give_infinity",
        "give_nan_horizon",
        "give_no_kind",
        "give_undeclared_kind",
        "give_all_kinds",
        "give_points_nowhere",
        "give_one_point",
        "give_points_backward",
        "answer_77",
        "fail_without_text",
        "fail_with_controls",
        "fail_with_broken_text",
        "fail_with_null",
        "fail_with_formats",
        "fail_at_reset",
    )
    | fails("^planner_(error|crashed|hung): ", "fail_at_length")
    | either(
        "give_flags",
        "give_size_zero",
        "give_size_huge",
        "give_endless_points",
        "give_points_not_aligned",
        "give_points_freed",
        "give_points_at_code",
        "log_null",
        "log_without_context",
        "ask_for_extension",
        "set_error_in_thread",
        "draw_endlessly",
    )
    | {name: Expectation(OWN) for name in ("give_huge", "give_denormal", "fly_by_the_clock", "never_arrive")}
)

# Other libraries, which act as they are loaded or taken out again.
LIBRARIES = {
    name: f"hostile_{name}"
    for name in (
        "load_exit",
        "load_exit_at_once",
        "load_abort",
        "load_sleep",
        "load_spin",
        "load_stop",
        "load_fork",
        "load_child",
        "load_close",
        "load_folder",
        "load_print",
        "load_signals",
        "load_round",
        "load_limit",
        "load_kill_parent",
        "unload_exit",
        "unload_abort",
        "unload_sleep",
    )
}
LOADS = (
    {
        name: Expectation(ENDS, "hostile_" + name, limit="load", codes=(2,), flies=False)
        for name in ("load_exit", "load_exit_at_once", "load_abort", "load_sleep", "load_spin")
    }
    | {
        name: Expectation(ANY, "hostile_" + name, limit="load", codes=(0, 2), flies=False)
        for name in ("load_fork", "load_close", "load_kill_parent")
    }
    | {name: Expectation(HONEST, limit="load") for name in ("unload_exit", "unload_abort", "unload_sleep")}
    | honest("load_stop", "load_child", "load_folder", "load_print", "load_signals", "load_round", "load_limit")
)

# A planner that says that it uses processes: "way+processes".
USES_PROCESSES = {f"{name}+processes": FORKS.get(name, PARENT.get(name)) for name in [*FORKS, *PARENT]} | honest(
    "fill_shared_memory+processes", "send_datagram+processes", "change_terminal+processes", "read_terminal+processes"
)
# It may signal its own processes, so that it can end itself as others would: the trial stays unflown, and the run says
# so.
USES_PROCESSES["kill_group+processes"] = Expectation(ANY, "not flown", codes=(0, 1))

# The same planner as a program, whose parent is its worker: "way+program".
PROGRAM = honest(
    *(
        f"{name}+program"
        for name in (
            "read_parent_memory",
            "write_parent_memory",
            "write_parents_files",
            "steal_parents_files",
            "trace_parent",
            "kill_parent",
            "stop_parent",
            "fill_shared_memory",
            "write_inherited",
            "read_terminal",
        )
    )
)

EXPECTED = (
    MEMORY
    | SIGNALS
    | PROCESSES
    | PARENT
    | DESCRIPTORS
    | FILES
    | RESULTS
    | TIMES
    | ENVIRONMENT
    | COMMANDS
    | LOADS
    | TERMINAL_WAYS
    | USES_PROCESSES
    | PROGRAM
)

# One or two of each kind, for every test run.
SHORT = [
    "fill_heap",
    "fill_children+processes",
    "write_null",
    "overflow_stack",
    "raise_abort",
    "end_by_pipe",
    "hold_watchdog_and_beat",
    "fork_and_return+processes",
    "fork_two_hundred+processes",
    "leave_daemon_with_pipes+processes",
    "become_sleep+processes",
    "terminate_parent",
    "kill_everyone",
    "trace_parent",
    "write_parent_memory",
    "steal_parents_files",
    "read_parent_memory+program",
    "write_inherited",
    "cover_pipes",
    "close_and_open",
    "print_results",
    "read_jobs",
    "remove_database",
    "update_rows",
    "lock_files",
    "change_good_planner",
    "call_newer_kernels",
    "leave_files",
    "fill_shared_memory+processes",
    "write_to_terminal",
    "freeze_terminal",
    "read_terminal+processes",
    "send_datagram",
    "forge_result",
    "forge_empty",
    "forge_error",
    "send_half_a_header",
    "send_huge_header",
    "stop_in_a_message",
    "sleep_in_each_call",
    "exit_well",
    "round_up",
    "write_commas",
    "fail_with_broken_text",
    "give_points_nowhere",
    "load_exit",
    "load_sleep",
    "unload_sleep",
]

# What would reach other processes or mounts of the machine if nothing stopped it.
NEED_PROCESSES = ["kill_everyone", "kill_everyone+processes", "kill_group", "kill_group+processes"]
NEED_MOUNTS = ["mount_over"]
TERMINAL = list(TERMINAL_WAYS)
