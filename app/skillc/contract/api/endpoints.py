"""The table of endpoints: routes of the server, OpenAPI document, clients and types of the studio are made of it.

What handles an endpoint is the function in `skillc.server.routes` that has its name.
"""

# fmt: off
from __future__ import annotations

from http import HTTPStatus
from types import NoneType
from typing import Any

from skillc.contract.access import LoginCode, MadeToken, NewToken, SessionInfo, TokenInfo
from skillc.contract.api.endpoint import Endpoint, Stream
from skillc.contract.api.version import VersionInfo
from skillc.contract.audit import AuditEntry, AuditPage
from skillc.contract.cell import (
    CellCheckpoint,
    CellStatus,
    CheckpointName,
    Disturbance,
    Lease,
    LeaseRequest,
    PaceSetting,
    ResetReason,
)
from skillc.contract.commands import OperatorCommand
from skillc.contract.device import DeviceStatus
from skillc.contract.geometry import CellModel, Coverage, Poses
from skillc.contract.job import (
    FILE_TYPES,
    Job,
    JobChanged,
    JobEvent,
    JobEventPage,
    JobPage,
    JobRequest,
    JobResult,
)
from skillc.contract.library import LibraryDescription, LibraryStatus
from skillc.contract.messages import Happened, StatusChanged
from skillc.contract.operation import OperationRequest, OperationStatus, QueueOrder, StopReason
from skillc.contract.order import Order, OrderRequest
from skillc.contract.runs.explanation import Question, RunExplanation
from skillc.contract.runs.history import EventPage, EventsHello, HistoryPage
from skillc.contract.runs.run_diff import OtherRun, RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.contract.sample import Sample, SampleHello
from skillc.contract.source import LanguageHello, SourceChange, SourceInfo, SourcePath, SourceText
from skillc.contract.world import (
    DocumentForm,
    FactPage,
    PlacedThing,
    QueryRows,
    StatableFacts,
    TermSubject,
    WorldEdit,
    WorldFacts,
    WorldPlacement,
    WorldQuery,
    WorldText,
    WorldWrite,
    WritePage,
)
from skillc.events import Envelope

NOT_FOUND, CONFLICT, STALE = HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT, HTTPStatus.PRECONDITION_FAILED
GONE, INVALID = HTTPStatus.REQUEST_TIMEOUT, HTTPStatus.UNPROCESSABLE_ENTITY
UNAVAILABLE = (HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE)
"""The statuses with which a cell that is busy or off refuses everything."""
OF_CELLS = (NOT_FOUND, CONFLICT, *UNAVAILABLE)
"""Those with which a cell refuses what it is asked or told."""
BINARY, METRICS = "application/octet-stream", "text/plain"

LIST_CELLS = Endpoint(
    "list_cells", "GET", "/cells", "view", "List the cells", tuple[CellStatus, ...], call="cells",
)
SHOW_CELL = Endpoint(
    "show_cell", "GET", "/cells/{cell}", "view", "Show a cell", CellStatus, refusals=(NOT_FOUND,), call="status",
)
SET_PACE = Endpoint(
    "set_pace", "PUT", "/cells/{cell}/pace", "operate", "Set the pace of a cell", CellStatus, body=PaceSetting,
    refusals=OF_CELLS, call=None,
)
ACKNOWLEDGE_FAULT = Endpoint(
    "acknowledge_fault", "POST", "/cells/{cell}/acknowledge", "operate",
    "Let a cell take operations again after a fault or a stop whose cause is removed", CellStatus, refusals=OF_CELLS,
    call="acknowledge",
)
STOP_CELL = Endpoint(
    "stop_cell", "POST", "/cells/{cell}/stop", "view", "Stop all operations of a cell", CellStatus, body=StopReason,
    needs_body=False, refusals=(NOT_FOUND,), unlimited=True, call="stop",
)

RESET_CELL = Endpoint(
    "reset_cell", "POST", "/cells/{cell}/reset", "operate",
    "Reset a simulated cell to its scene: its world and its reality", CellStatus, body=ResetReason,
    needs_body=False, refusals=OF_CELLS, call="reset",
)
LIST_CHECKPOINTS = Endpoint(
    "list_checkpoints", "GET", "/cells/{cell}/checkpoints", "view", "List the checkpoints of a simulated cell, by name",
    tuple[CellCheckpoint, ...], refusals=(NOT_FOUND,), call="checkpoints",
)
SAVE_CELL = Endpoint(
    "save_cell", "POST", "/cells/{cell}/checkpoints", "operate",
    "Save a simulated cell, its world and its reality, as a checkpoint", CellCheckpoint, body=CheckpointName,
    status=HTTPStatus.CREATED, refusals=OF_CELLS, call="save",
)
RESTORE_CELL = Endpoint(
    "restore_cell", "POST", "/cells/{cell}/checkpoints/{checkpoint}/restore", "operate",
    "Restore a simulated cell from a checkpoint", CellStatus, body=ResetReason, needs_body=False, refusals=OF_CELLS,
    call="restore",
)
REMOVE_CHECKPOINT = Endpoint(
    "remove_checkpoint", "DELETE", "/cells/{cell}/checkpoints/{checkpoint}", "operate",
    "Remove a checkpoint of a simulated cell", NoneType, status=HTTPStatus.NO_CONTENT, refusals=OF_CELLS,
)

DISTURB_CELL = Endpoint(
    "disturb_cell", "POST", "/cells/{cell}/disturbances", "operate",
    "Let something happen to a simulated cell that no skill does", CellStatus, body=Disturbance, refusals=OF_CELLS,
    call=None,
)

SHOW_MODEL = Endpoint(
    "show_model", "GET", "/cells/{cell}/model", "view",
    "Show the shapes and joints of a simulated cell, as they really are", CellModel, refusals=OF_CELLS, call="model",
)
LIST_POSES = Endpoint(
    "list_poses", "GET", "/cells/{cell}/poses", "view", "List where the world of a cell has individuals, by IRI",
    Poses, refusals=OF_CELLS, call="poses",
)
SHOW_COVERAGE = Endpoint(
    "show_coverage", "GET", "/cells/{cell}/coverage", "view", "Show where tools have really worked on surfaces",
    Coverage, refusals=OF_CELLS, call="coverage",
)

SHOW_LEASE = Endpoint(
    "show_lease", "GET", "/cells/{cell}/lease", "view", "Show who has the lease of a cell", Lease,
    refusals=(NOT_FOUND,), call="lease",
)
TAKE_LEASE = Endpoint(
    "take_lease", "PUT", "/cells/{cell}/lease", "operate", "Take the lease of a cell, or prolong it", Lease,
    body=LeaseRequest, refusals=(NOT_FOUND, CONFLICT),
)
RELEASE_LEASE = Endpoint(
    "release_lease", "DELETE", "/cells/{cell}/lease", "operate", "Give the lease of a cell back", NoneType,
    status=HTTPStatus.NO_CONTENT, refusals=(NOT_FOUND, CONFLICT),
)

LIST_OPERATIONS = Endpoint(
    "list_operations", "GET", "/cells/{cell}/operations", "view", "List the operations of a cell, the last one first",
    tuple[OperationStatus, ...], query=HistoryPage, refusals=(NOT_FOUND,), call=None,
)
SUBMIT_OPERATION = Endpoint(
    "submit_operation", "POST", "/cells/{cell}/operations", "operate", "Submit an operation", OperationStatus,
    body=OperationRequest, status=HTTPStatus.CREATED, refusals=OF_CELLS, takes_key=True, call=None,
)
SHOW_OPERATION = Endpoint(
    "show_operation", "GET", "/operations/{operation}", "view", "Show an operation", OperationStatus,
    refusals=(NOT_FOUND,), call=None,
)
GIVE_COMMAND = Endpoint(
    "give_command", "POST", "/operations/{operation}/commands", "operate", "Give a command to an operation",
    OperationStatus, body=OperatorCommand, refusals=OF_CELLS, call=None,
)
STOP_OPERATION = Endpoint(
    "stop_operation", "POST", "/operations/{operation}/stop", "view",
    "Stop an operation; nothing happens if it has ended", OperationStatus, body=StopReason, needs_body=False,
    refusals=(NOT_FOUND,), unlimited=True, call=None,
)
LIST_EVENTS = Endpoint(
    "list_events", "GET", "/operations/{operation}/events", "view", "Read the events of an operation",
    tuple[Envelope, ...], query=EventPage, refusals=(NOT_FOUND,), call=None,
)

ADD_ORDER = Endpoint(
    "add_order", "POST", "/cells/{cell}/orders", "operate", "Order an operation at a time, or again and again", Order,
    body=OrderRequest, status=HTTPStatus.CREATED, refusals=OF_CELLS, takes_key=True, call=None,
)
LIST_ORDERS = Endpoint(
    "list_orders", "GET", "/cells/{cell}/orders", "view", "List the orders for a cell", tuple[Order, ...],
    refusals=(NOT_FOUND,), call="orders",
)
REMOVE_ORDER = Endpoint(
    "remove_order", "DELETE", "/orders/{order}", "operate", "Remove an order; what it has submitted goes on", NoneType,
    status=HTTPStatus.NO_CONTENT, refusals=(NOT_FOUND,), call=None,
)

LIST_QUEUE = Endpoint(
    "list_queue", "GET", "/cells/{cell}/queue", "view",
    "List the operations that wait in a cell, in the order in which they get planners and devices",
    tuple[OperationStatus, ...], refusals=(NOT_FOUND,), call="queue",
)
REORDER_QUEUE = Endpoint(
    "reorder_queue", "PUT", "/cells/{cell}/queue", "operate",
    "Put operations before all others that wait in a cell, whatever their priority", tuple[OperationStatus, ...],
    body=QueueOrder, refusals=OF_CELLS, call="reorder",
)

READ_RECORDING = Endpoint(
    "read_recording", "GET", "/operations/{operation}/recording", "view",
    "Read the recording of an operation, an MCAP file, as far as it is written", NoneType, refusals=(NOT_FOUND,),
    media_types=(BINARY,), call=None,
)

SHOW_TREE = Endpoint(
    "show_tree", "GET", "/operations/{operation}/tree", "view",
    "Show the tree of an operation, with the numbers that events have", OperationTree,
    refusals=(NOT_FOUND, GONE, INVALID), call="tree",
)
EXPLAIN_RUN = Endpoint(
    "explain_run", "GET", "/operations/{operation}/why", "view",
    "Explain what an operation has chosen, how it ended, and why", RunExplanation, query=Question,
    refusals=(NOT_FOUND, GONE, INVALID), call="explain",
)
READ_SIGNALS = Endpoint(
    "read_signals", "GET", "/operations/{operation}/signals", "view",
    "Read recorded signals of an operation, at most 5000 rows at once", SignalRows, query=SignalPage,
    refusals=(NOT_FOUND, GONE, INVALID), call="signals",
)
COMPARE_RUNS = Endpoint(
    "compare_runs", "GET", "/operations/{operation}/diff", "view", "Compare an operation with another one", RunDiff,
    query=OtherRun, refusals=(NOT_FOUND, GONE, INVALID), call="compare",
)

LIST_FACTS = Endpoint(
    "list_facts", "GET", "/cells/{cell}/world", "view", "List facts of the world of a cell", WorldFacts,
    query=FactPage, refusals=OF_CELLS, call=None,
)
WRITE_WORLD = Endpoint(
    "write_world", "GET", "/cells/{cell}/world/document", "view", "Write the world of a cell as RDF or as a picture",
    WorldText, query=DocumentForm, refusals=OF_CELLS, call=None,
)
LIST_TERMS = Endpoint(
    "list_terms", "GET", "/cells/{cell}/world/terms", "view",
    "List the relations and properties that facts about a thing may have", StatableFacts, query=TermSubject,
    refusals=OF_CELLS, call=None,
)
LIST_THINGS = Endpoint(
    "list_things", "GET", "/cells/{cell}/things", "view",
    "List what has a place or a size in a cell, as it is believed", tuple[PlacedThing, ...], refusals=OF_CELLS,
    call="things",
)
QUERY_WORLD = Endpoint(
    "query_world", "POST", "/cells/{cell}/world/query", "view", "Answer a SPARQL query about the world of a cell",
    QueryRows, body=WorldQuery, refusals=OF_CELLS, call=None,
)
EDIT_WORLD = Endpoint(
    "edit_world", "POST", "/cells/{cell}/world/edits", "edit", "Change the world of a cell in one transaction",
    NoneType, body=WorldEdit, status=HTTPStatus.NO_CONTENT, refusals=OF_CELLS, call=None,
)
PLACE_THING = Endpoint(
    "place_thing", "POST", "/cells/{cell}/world/placements", "edit",
    "Say where a thing is in the world of a cell; nothing moves", NoneType, body=WorldPlacement,
    status=HTTPStatus.NO_CONTENT, refusals=OF_CELLS,
)
LIST_WRITES = Endpoint(
    "list_writes", "GET", "/cells/{cell}/world/history", "view",
    "List who has written what to the world of a cell, and when", tuple[WorldWrite, ...], query=WritePage,
    refusals=OF_CELLS, call=None,
)

SHOW_VERSION = Endpoint(
    "show_version", "GET", "/version", "view", "Show the versions of skillc and of the API", VersionInfo,
    call="version",
)
LIST_LIBRARIES = Endpoint(
    "list_libraries", "GET", "/libraries", "view", "List the libraries, and why the one on disk is not used",
    tuple[LibraryStatus, ...], call="libraries",
)
SHOW_LIBRARY = Endpoint(
    "show_library", "GET", "/cells/{cell}/library", "view", "Describe the library of a cell", LibraryDescription,
    refusals=(NOT_FOUND,), call="library",
)
LIST_ROBOTS = Endpoint(
    "list_robots", "GET", "/cells/{cell}/robots", "view", "List the devices of a cell, and which operation holds each",
    tuple[DeviceStatus, ...], refusals=OF_CELLS, call="robots",
)

ADD_JOB = Endpoint(
    "add_job", "POST", "/jobs", "view",
    "Begin work for a cell: `plan`, `rehearsal`, `trials`, `trial-replay` or `report`; all but a plan need `operate`",
    Job, body=JobRequest, status=HTTPStatus.CREATED, refusals=OF_CELLS, call=None,
)
LIST_JOBS = Endpoint(
    "list_jobs", "GET", "/jobs", "view", "List the jobs of all cells, or of one", tuple[Job, ...], query=JobPage,
    refusals=(NOT_FOUND,), call="jobs",
)
SHOW_JOB = Endpoint("show_job", "GET", "/jobs/{job}", "view", "Show a job", Job, refusals=(NOT_FOUND,), call="job")
SHOW_JOB_RESULT = Endpoint(
    "show_job_result", "GET", "/jobs/{job}/result", "view", "Show what came of a job; of trials also while they go on",
    JobResult, refusals=(NOT_FOUND, CONFLICT), call="job_result",
)
LIST_JOB_EVENTS = Endpoint(
    "list_job_events", "GET", "/jobs/{job}/events", "view", "Read the log of a job, or wait for its next line",
    tuple[JobEvent, ...], query=JobEventPage, refusals=(NOT_FOUND,), call="job_events",
)
READ_JOB_FILE = Endpoint(
    "read_job_file", "GET", "/jobs/{job}/files/{file}", "view",
    "Read a file that a job has left: a recording, a film, a report, a picture", NoneType, refusals=(NOT_FOUND,),
    media_types=tuple(FILE_TYPES.values()), call=None,
)
CANCEL_JOB = Endpoint(
    "cancel_job", "POST", "/jobs/{job}/cancel", "view", "End a job that goes on; nothing happens to others", Job,
    refusals=(NOT_FOUND,),
)
RESTART_JOB = Endpoint(
    "restart_job", "POST", "/jobs/{job}/restart", "view",
    "Begin a job again that failed, was cancelled or interrupted; trials go on with those that are missing", Job,
    refusals=OF_CELLS,
)
REMOVE_JOB = Endpoint(
    "remove_job", "DELETE", "/jobs/{job}", "view", "End and forget a job, with its log, its result and its files",
    NoneType, status=HTTPStatus.NO_CONTENT, refusals=(NOT_FOUND,),
)

MAKE_LOGIN_CODE = Endpoint(
    "make_login_code", "POST", "/login-codes", "view",
    "Make a code that stands for the client's token, once, for 60 s", LoginCode, status=HTTPStatus.CREATED, call=None,
)
SHOW_SESSION = Endpoint(
    "show_session", "GET", "/session", "view", "Show who makes the request, and its role", SessionInfo, call=None,
)
LOG_IN = Endpoint(
    "log_in", "POST", "/session", "view",
    "Begin a session: the cookie of the answer stands for the token or code for 12 h", NoneType,
    status=HTTPStatus.NO_CONTENT, call=None,
)
LOG_OUT = Endpoint(
    "log_out", "DELETE", "/session", "view", "End the session of the cookie", NoneType, status=HTTPStatus.NO_CONTENT,
    call=None,
)

LIST_LIBRARY_SOURCES = Endpoint(
    "list_library_sources", "GET", "/libraries/{library}/files", "view",
    "List the texts of a library, and those that it may import", tuple[SourceInfo, ...], refusals=(NOT_FOUND,),
)
READ_LIBRARY_SOURCE = Endpoint(
    "read_library_source", "GET", "/libraries/{library}/file", "view", "Read a text of a library", SourceText,
    query=SourcePath, refusals=(NOT_FOUND,),
)
CHANGE_LIBRARY_SOURCE = Endpoint(
    "change_library_source", "PUT", "/libraries/{library}/file", "edit",
    "Change a text of a library, unless somebody else has meanwhile", SourceText, body=SourceChange, query=SourcePath,
    refusals=(NOT_FOUND, CONFLICT, STALE),
)

LIST_TOKENS = Endpoint(
    "list_tokens", "GET", "/tokens", "admin", "List the tokens", tuple[TokenInfo, ...], call="tokens",
)
ADD_TOKEN = Endpoint(
    "add_token", "POST", "/tokens", "admin", "Make a token", MadeToken, body=NewToken, status=HTTPStatus.CREATED,
    refusals=(CONFLICT,), call=None,
)
REVOKE_TOKEN = Endpoint(
    "revoke_token", "DELETE", "/tokens/{name}", "admin", "Revoke a token", NoneType, status=HTTPStatus.NO_CONTENT,
    refusals=(NOT_FOUND, CONFLICT),
)

LIST_AUDIT_ENTRIES = Endpoint(
    "list_audit_entries", "GET", "/audit", "admin",
    "Read the audit log: what was changed, by whom, and what was refused", tuple[AuditEntry, ...], query=AuditPage,
)

SHOW_METRICS = Endpoint(
    "show_metrics", "GET", "/metrics", "view", "Read the metrics of the server for Prometheus", NoneType,
    media_types=(METRICS,), call=None,
)

ENDPOINTS: tuple[Endpoint[Any], ...] = tuple(each for each in tuple(globals().values()) if isinstance(each, Endpoint))
"""All of them, in the order of this file."""

STREAM_EVENTS = Stream(
    "stream_events", "/events", "view",
    "Follow cells, operations and jobs, or the events of one operation without a gap",
    EventsHello, list[Happened | StatusChanged | JobChanged] | list[Envelope],
)
STREAM_SAMPLES = Stream(
    "stream_samples", "/samples", "view", "Follow what moves in a cell", SampleHello, Sample, binary=True,
)
STREAM_LANGUAGE = Stream(
    "stream_language", "/lsp", "view", "Talk to the language server of a library (LSP)", LanguageHello, Any,
)
STREAMS = (STREAM_EVENTS, STREAM_SAMPLES, STREAM_LANGUAGE)
