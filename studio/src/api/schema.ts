// Made from the OpenAPI document of the server by `npm run types`; do not edit.

export type paths = Record<string, never>;
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /**
         * CellStatus
         * @description A cell as it is now; `reason` is why it is in its state.
         *
         *         `library_hash` identifies the library that its next operation runs; `library_problem` is why that is not the one on
         *         disk. `pace` is None for as fast as it computes; that of a `paceable` cell can be set. A `resettable` cell can be
         *         reset to its scene, saved and restored.
         *         `resets` counts the resets and restores since its process was started; what was seen before the last one is past.
         */
        CellStatus: {
            name: string;
            scene: string;
            library: string;
            library_hash: string;
            /** @default  */
            library_problem?: string;
            backend: string;
            /**
             * @default operational
             * @enum {unknown}
             */
            state?: "emergency-stop" | "fault" | "off" | "operational" | "protective-stop";
            /** @default  */
            reason?: string;
            /** @default null */
            pace?: number | null;
            /** @default false */
            paceable?: boolean;
            /** @default false */
            resettable?: boolean;
            /** @default 0 */
            resets?: number;
        };
        /**
         * PaceSetting
         * @description How fast the cell's time may pass: `factor` times real time; null for as fast as it computes.
         */
        PaceSetting: {
            factor: number | null;
        };
        /**
         * StopReason
         * @description Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored.
         */
        StopReason: {
            /** @default stopped */
            reason?: string;
        };
        /**
         * ResetReason
         * @description The reason for a reset or a restore, for the history of the world.
         */
        ResetReason: {
            /** @default  */
            why?: string;
        };
        /**
         * CellCheckpoint
         * @description A simulated cell as `who` has saved it, at the wall time `saved_ns` in ns since 1970.
         *
         *         Only a cell with the same scene, library, back end and seed can be restored from it. `scene` is the name of its
         *         file, with a digest of the content.
         */
        CellCheckpoint: {
            name: string;
            who: string;
            saved_ns: number;
            scene: string;
            library_hash: string;
            backend: string;
            seed: number;
        };
        /**
         * CheckpointName
         * @description The name of a new checkpoint: letters, digits, `_`, `-` and `.`.
         */
        CheckpointName: {
            name: string;
        };
        /**
         * PushArm
         * @description Somebody pushes the hand of an arm with a force (x, y, z) in N in the world, from now on for `duration_s` s.
         */
        PushArm: {
            /** @enum {unknown} */
            type: "push";
            arm: string;
            force_n: [
                number,
                number,
                number
            ];
            /** @default 0.5 */
            duration_s?: number;
        };
        /**
         * MoveThing
         * @description Somebody moves a thing by (x, y, z) in m in the world, and turns it about the vertical, in rad.
         */
        MoveThing: {
            /** @enum {unknown} */
            type: "move";
            thing: string;
            by_m: [
                number,
                number,
                number
            ];
            /** @default 0 */
            turn_rad?: number;
        };
        /**
         * TakeThing
         * @description Somebody takes a thing out of the hand that holds it, moves it by (x, y, z) in m in the world, and lets it go.
         */
        TakeThing: {
            /** @enum {unknown} */
            type: "take";
            thing: string;
            /**
             * @default [
             *       0,
             *       0.3,
             *       0
             *     ]
             */
            by_m?: [
                number,
                number,
                number
            ];
        };
        /**
         * PressEmergencyStop
         * @description Somebody presses an emergency stop, or releases it.
         */
        PressEmergencyStop: {
            /** @enum {unknown} */
            type: "emergency-stop";
            /** @default true */
            pressed?: boolean;
        };
        /**
         * LoseArm
         * @description An arm does not answer any more, or answers again; it stands still meanwhile.
         */
        LoseArm: {
            /** @enum {unknown} */
            type: "lost-arm";
            arm: string;
            /** @default true */
            lost?: boolean;
        };
        /**
         * CellModel
         * @description The geometry of a cell as it really is, empty if it cannot be drawn; individuals and arms are by IRI.
         */
        CellModel: {
            bodies: components["schemas"]["ModelBody"][];
            meshes: components["schemas"]["ModelMesh"][];
            individuals: {
                [key: string]: components["schemas"]["ModelIndividual"];
            };
            arms: {
                [key: string]: components["schemas"]["ModelArm"];
            };
        };
        /**
         * ModelBody
         * @description A body after its parent, whose number is -1 for the world, at a pose in the parent while its joints rest.
         *
         *         `individual` is the IRI of what it is a part of; None for the floor.
         */
        ModelBody: {
            name: string;
            parent: number;
            pose: [
                number,
                number,
                number,
                number,
                number,
                number,
                number
            ];
            joints: components["schemas"]["ModelJoint"][];
            geoms: components["schemas"]["ModelGeom"][];
            individual: string | null;
        };
        /**
         * ModelJoint
         * @description A joint between a body and its parent: it turns about, or slides along, `axis` through `anchor` in the body.
         *
         *         `rest` is its value, in rad or m, with which the body has its own pose in the parent.
         */
        ModelJoint: {
            name: string;
            /** @enum {unknown} */
            kind: "ball" | "free" | "hinge" | "slide";
            axis: [
                number,
                number,
                number
            ];
            anchor: [
                number,
                number,
                number
            ];
            rest: number;
        };
        /**
         * ModelGeom
         * @description A shape at a pose in its body; `colour` is red, green, blue and opacity from 0 to 1.
         *
         *         `size`: half the extent of boxes and ellipsoids; radius and half the length along z, without the ends, of cylinders
         *         and capsules; radius of spheres. `mesh` is the number of a mesh.
         */
        ModelGeom: {
            /** @enum {unknown} */
            shape: "box" | "capsule" | "cylinder" | "ellipsoid" | "mesh" | "plane" | "sphere";
            size: [
                number,
                number,
                number
            ];
            pose: [
                number,
                number,
                number,
                number,
                number,
                number,
                number
            ];
            colour: [
                number,
                number,
                number,
                number
            ];
            /** @default null */
            mesh?: number | null;
        };
        /**
         * ModelMesh
         * @description Points in m, three numbers each, and triangles, three numbers of points each.
         */
        ModelMesh: {
            points: number[];
            triangles: number[];
        };
        /**
         * ModelIndividual
         * @description An individual with its short name, whose own frame is at the pose `frame` in the body with a number.
         *
         *         What is `movable` can be moved by a disturbance while nothing holds it.
         */
        ModelIndividual: {
            label: string;
            /** @enum {unknown} */
            kind: "arm" | "base" | "body" | "fixture" | "gripper" | "surface" | "tool";
            body: number;
            frame: [
                number,
                number,
                number,
                number,
                number,
                number,
                number
            ];
            /** @default false */
            movable?: boolean;
        };
        /**
         * ModelArm
         * @description An arm: samples have the frame of its individual as `base`, and the angles of `joints`, which are names.
         */
        ModelArm: {
            joints: string[];
        };
        /**
         * SurfaceCoverage
         * @description How long tools have really worked on each cell of a surface of `size` in m, about its middle.
         *
         *         `dose` has a byte a cell, first along x, then along y: the time in units of `unit_s`, at most 255; empty for none.
         */
        SurfaceCoverage: {
            size: [
                number,
                number
            ];
            columns: number;
            rows: number;
            unit_s: number;
            dose: string;
        };
        /**
         * Lease
         * @description The lease of a cell: who has it, and for how long yet, in s of wall time; nobody if `owner` is None.
         */
        Lease: {
            cell: string;
            owner: string | null;
            remaining_s: number;
        };
        /**
         * LeaseRequest
         * @description For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client.
         */
        LeaseRequest: {
            /** @default 60 */
            duration_s?: number;
            /** @default false */
            takeover?: boolean;
        };
        /**
         * OperationStatus
         * @description An operation as it is now: `reason` says why it is in its state, or for what it waits.
         *
         *         `contact` is what becomes of a tool that pressed when it was paused: it presses on, it is being taken off, it was
         *         taken off, or it approaches until it senses contact.
         *         `allowed` are the names of the commands that it allows. `events` is the number of its last event. `verified` is
         *         whether a success rests on no fact that is only assumed, and no claim is false; None if it did not succeed.
         *         It was submitted, its first attempt began, and it ended at `submitted_at`, `started_at` and `ended_at`, null before.
         *         `failure` is why it did not succeed, or why the step failed after which somebody has to decide how it goes on.
         *         `outputs` are what its outermost calls have returned, `measures` the properties that it has measured, so far; of
         *         each the last hundred.
         *         `false_claims` are sentences about what the world model claimed at its end that is not so in the simulator.
         *         `library_hash` identifies what it runs. `devices` are the IRIs of those that it holds, null for the whole cell.
         *         `prompts` are what its skills ask operators. `planning` is how far its planner is; null if none works. `breakpoints`
         *         are those at which it pauses now. `decisions` are how it can be continued if it was interrupted, `continued_by` is
         *         the operation that does. `place` is its place among those of its cell that wait, from 1; 0 if it does not wait.
         */
        OperationStatus: {
            id: string;
            cell: string;
            request: components["schemas"]["OperationRequest"];
            state: ("paused" | "pausing" | "planned" | "planning" | "queued" | "running" | "stopping") | ("failed" | "interrupted" | "stopped" | "succeeded");
            /** @default  */
            reason?: string;
            /**
             * @default none
             * @enum {unknown}
             */
            contact?: "approaching" | "kept" | "lifting" | "none" | "taken-off";
            /** @default [] */
            allowed?: string[];
            /** @default 0 */
            events?: number;
            /** @default null */
            verified?: boolean | null;
            /** @default [] */
            false_claims?: string[];
            /** @default null */
            submitted_at?: string | null;
            /** @default null */
            started_at?: string | null;
            /** @default null */
            ended_at?: string | null;
            /** @default null */
            failure?: components["schemas"]["Failure"] | null;
            /** @default [] */
            outputs?: components["schemas"]["CallOutput"][];
            /** @default [] */
            measures?: components["schemas"]["MeasuredProperty"][];
            /** @default  */
            library_hash?: string;
            /** @default [] */
            devices?: string[] | null;
            /** @default [] */
            prompts?: components["schemas"]["Prompt"][];
            /** @default null */
            planning?: components["schemas"]["PlanningProgress"] | null;
            /** @default [] */
            breakpoints?: string[];
            /** @default [] */
            decisions?: ("replan" | "retry" | "skip")[];
            /** @default  */
            continued_by?: string;
            /** @default 0 */
            place?: number;
        };
        /**
         * OperationRequest
         * @description What is to be done in a cell, with its library, and how; `owner` is who requested it.
         *
         *         A request that `continues` an operation that was interrupted names nothing else to do; `decision` says how, and
         *         `why` a step counts as done that is skipped.
         */
        OperationRequest: {
            /**
             * @description The name of a task.
             * @default null
             */
            task?: string | null;
            /**
             * @description The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`.
             * @default {}
             */
            arguments?: {
                [key: string]: string;
            };
            /**
             * @description Instead of a task: plan for this goal, a condition, PDDL or JSON.
             * @default null
             */
            goal?: string | null;
            /**
             * @description Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`.
             * @default null
             */
            call?: string | null;
            /**
             * @description Look whether the arms can carry out a plan, before anything moves.
             * @default true
             */
            geometry?: boolean;
            /**
             * @description Let each plan, also a new one, wait for approval.
             * @default false
             */
            approve?: boolean;
            /**
             * @description Let a failed step wait for a decision instead of another plan.
             * @default false
             */
            ask_after_failure?: boolean;
            /**
             * @description Let the task fail if it has not ended after these seconds of the cell's time; also limits planning.
             * @default null
             */
            deadline_s?: number | null;
            /**
             * @description Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those that it was paused.
             * @default null
             */
            step_deadline_s?: number | null;
            /**
             * @description Pause before the first call, and go on step by step.
             * @default false
             */
            step?: boolean;
            /**
             * @description Pause before each call of a skill, or before the calls in a line.
             * @default []
             */
            breakpoints?: string[];
            /**
             * @description Pause before each step, with the arms held, until somebody lets the task go on.
             * @default false
             */
            confirm_steps?: boolean;
            /**
             * @description Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are.
             * @default 1
             */
            speed?: number;
            /**
             * @description Of those that wait for planners or devices, the higher comes first; nothing that runs gives way.
             * @default 0
             */
            priority?: number;
            /** @default  */
            owner?: string;
            /** @default  */
            continues?: string;
            /**
             * @default replan
             * @enum {unknown}
             */
            decision?: "replan" | "retry" | "skip";
            /** @default  */
            why?: string;
        };
        /**
         * Failure
         * @description Why a node failed; `source` is the responsible line, `skill` the innermost skill.
         *
         *         `message` is the cause in one sentence, `detail` what there is to say besides. `values` are the values in a
         *         primitive's message, by name. `causes` are the failures that this one combines, those of all alternatives that were
         *         tried: first the one whose message it has. `alternative` names one of several, for example `Pick[across]`.
         */
        Failure: {
            /** @enum {unknown} */
            kind: "always" | "body" | "contradiction" | "error" | "halted" | "hold" | "inference" | "interrupted" | "lock" | "plan" | "post" | "pre" | "space" | "timeout" | "verify";
            message: string;
            /** @default  */
            detail?: string;
            /** @default null */
            source?: components["schemas"]["Position"] | null;
            /** @default  */
            skill?: string;
            /** @default  */
            alternative?: string;
            /** @default {} */
            values?: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            /** @default [] */
            causes?: components["schemas"]["Failure"][];
        };
        /**
         * Position
         * @description A position in a file: path relative to the library (or `std/..`), line and column from 1.
         */
        Position: {
            path: string;
            line: number;
            column: number;
        };
        /**
         * LabelledIri
         * @description An individual, class, relation or property; `label` is its short name, such as `lab:Arm-1` or `contain`.
         */
        LabelledIri: {
            /** @enum {unknown} */
            type: "iri";
            iri: string;
            label: string;
        };
        /**
         * LabelledQuantity
         * @description A number with its SI unit, a temperature in degC; the unit is empty for a pure number.
         *
         *         In a message `{depth:.1f mm}` shows it with one digit in mm, `{depth}` with its unit.
         */
        LabelledQuantity: {
            /** @enum {unknown} */
            type: "quantity";
            value: number;
            /** @default  */
            unit?: string;
        };
        /**
         * NotFinite
         * @description A number that JSON cannot represent, as text: `inf N`.
         */
        NotFinite: {
            /** @enum {unknown} */
            type: "not-finite";
            text: string;
        };
        /**
         * LabelledVector
         * @description Three numbers with one unit, in the world frame.
         */
        LabelledVector: {
            /** @enum {unknown} */
            type: "vector";
            components: [
                number,
                number,
                number
            ];
            /** @default  */
            unit?: string;
        };
        /**
         * LabelledPose
         * @description A position in m and an orientation as unit quaternion (w, x, y, z), in a frame.
         */
        LabelledPose: {
            /** @enum {unknown} */
            type: "pose";
            position_m: [
                number,
                number,
                number
            ];
            quaternion_wxyz: [
                number,
                number,
                number,
                number
            ];
            /** @default world */
            frame?: string;
        };
        /**
         * ValueList
         * @description Several values.
         */
        ValueList: {
            /** @enum {unknown} */
            type: "list";
            values: (boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]))[];
        };
        /**
         * CallOutput
         * @description What an outermost call of a run has returned for its parameter `name`; `node` is its number in the events.
         */
        CallOutput: {
            skill: string;
            node: number;
            name: string;
            value: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
        };
        /**
         * MeasuredProperty
         * @description The value of a property that a skill or a device, `by`, has found last, at the time `time_s` of the cell.
         */
        MeasuredProperty: {
            fact: components["schemas"]["LabelledProperty"];
            /** @enum {unknown} */
            known: "assumed" | "idealised" | "reported" | "sensed";
            by: string;
            time_s: number;
        };
        /**
         * LabelledProperty
         * @description A property of an individual with its value; None for no value.
         */
        LabelledProperty: {
            /** @enum {unknown} */
            type: "property";
            individual: components["schemas"]["LabelledIri"];
            property: components["schemas"]["LabelledIri"];
            value: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]) | null;
        };
        /**
         * Prompt
         * @description A question of a skill with its choices, and until when, in s of the cell's clock, an operator may answer it.
         *
         *         The `default` counts then; if it is empty, the skill fails. `id` is the number of the node that asks.
         */
        Prompt: {
            text: string;
            choices: string[];
            ends_s: number;
            /** @default  */
            default?: string;
            /** @default 0 */
            id?: number;
        };
        /**
         * PlanningProgress
         * @description A `planner` plans with a number of `individuals`, which are only a part of the scene if they are `narrowed`.
         *
         *         Of plans with these, it has found one that takes `best_s` (in s; None for none yet) and proved that any takes at
         *         least `at_least_s`. If it `costs`, these are what plans cost, not seconds. `states` is how many it has evaluated.
         */
        PlanningProgress: {
            planner: string;
            /** @default 0 */
            individuals?: number;
            /** @default false */
            narrowed?: boolean;
            /** @default null */
            best_s?: number | null;
            /** @default 0 */
            at_least_s?: number;
            /** @default 0 */
            states?: number;
            /** @default false */
            costs?: boolean;
        };
        /**
         * Approve
         * @description Run the plan that waits for approval.
         */
        Approve: {
            /** @enum {unknown} */
            type: "approve";
            /** @default  */
            who?: string;
        };
        /**
         * PauseRun
         * @description Pause at the next point where all active skills may be paused.
         */
        PauseRun: {
            /** @enum {unknown} */
            type: "pause";
            /** @default requested */
            reason?: string;
            /** @default  */
            who?: string;
        };
        /**
         * Resume
         * @description Continue after a pause.
         */
        Resume: {
            /** @enum {unknown} */
            type: "resume";
            /** @default  */
            who?: string;
        };
        /**
         * StepInto
         * @description Continue until the next call starts.
         */
        StepInto: {
            /** @enum {unknown} */
            type: "step-into";
            /** @default  */
            who?: string;
        };
        /**
         * StepOver
         * @description Continue until a call starts that is not part of the current one.
         */
        StepOver: {
            /** @enum {unknown} */
            type: "step-over";
            /** @default  */
            who?: string;
        };
        /**
         * StepOut
         * @description Continue until a call starts that is not part of the call around the current one.
         */
        StepOut: {
            /** @enum {unknown} */
            type: "step-out";
            /** @default  */
            who?: string;
        };
        /**
         * RetryStep
         * @description After a failure: run the failed step again.
         */
        RetryStep: {
            /** @enum {unknown} */
            type: "retry";
            /** @default  */
            who?: string;
        };
        /**
         * Skip
         * @description After a failure: count the failed step as done, because somebody did it; its effects are assumed.
         */
        Skip: {
            /** @enum {unknown} */
            type: "skip";
            why: string;
            /** @default  */
            who?: string;
        };
        /**
         * Replan
         * @description Halt what runs and plan again.
         */
        Replan: {
            /** @enum {unknown} */
            type: "replan";
            /** @default  */
            who?: string;
        };
        /**
         * AnswerPrompt
         * @description Answer what a skill asks with one of its choices; `prompt` is its number, 0 for the only one.
         */
        AnswerPrompt: {
            /** @enum {unknown} */
            type: "answer";
            choice: string;
            /** @default 0 */
            prompt?: number;
            /** @default  */
            who?: string;
        };
        /**
         * SetBreakpoints
         * @description Pause at these breakpoints from now on, each SKILL or FILE:LINE, and at no others.
         */
        SetBreakpoints: {
            /** @enum {unknown} */
            type: "set-breakpoints";
            breakpoints: string[];
            /** @default  */
            who?: string;
        };
        /**
         * Envelope
         * @description An event of the run with the id `run`; `sequence` numbers the events of a run from 1 without gaps.
         *
         *         `wall_time_ns` is in ns since 1970-01-01 UTC.
         */
        Envelope: {
            run: string;
            sequence: number;
            wall_time_ns: number;
            event: components["schemas"]["TaskStarted"] | components["schemas"]["StateChanged"] | components["schemas"]["Requested"] | components["schemas"]["Disturbed"] | components["schemas"]["PlanArrived"] | components["schemas"]["PlanMade"] | components["schemas"]["PromptsChanged"] | components["schemas"]["Replanned"] | components["schemas"]["NodeStarted"] | components["schemas"]["NodeEnded"] | components["schemas"]["ImplementationChosen"] | components["schemas"]["WorldChanged"] | components["schemas"]["Note"] | components["schemas"]["Paused"] | components["schemas"]["Resumed"] | components["schemas"]["TaskEnded"];
        };
        /**
         * TaskStarted
         * @description A task starts; `library` and `hash` identify the compiled library, `format` is the format of the events.
         *
         *         The objective is a `goal`, with what the plan minimises, or a `body` to run as it is; the task may take `within_s`
         *         of the cell's time, in s, and may break none of the conditions `always`. Several tasks that are carried out as one
         *         are its `parts`. `scene`, `seed` and `backend`
         *         are those of the cell; `scene` is empty if the world came from elsewhere, for example from a store. The run pauses
         *         at `breakpoints`, each SKILL or FILE:LINE, and before its first call if it is `stepped`.
         */
        TaskStarted: {
            /** @enum {unknown} */
            type: "task-started";
            time: number;
            format: number;
            task: string;
            /** @default  */
            library?: string;
            /** @default  */
            hash?: string;
            /** @default  */
            scene?: string;
            /** @default 0 */
            seed?: number;
            /** @default  */
            backend?: string;
            /** @default null */
            goal?: (components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"]) | null;
            /**
             * @default
             * @enum {unknown}
             */
            minimise?: "" | "cost" | "makespan" | "work";
            /** @default null */
            body?: (components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"]) | null;
            /** @default null */
            within_s?: number | null;
            /** @default [] */
            always?: (components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"])[];
            /** @default [] */
            parts?: components["schemas"]["TaskPart"][];
            /** @default {} */
            settings?: components["schemas"]["RunSpec"];
            /** @default [] */
            breakpoints?: string[];
            /** @default false */
            stepped?: boolean;
            /** @default null */
            source?: components["schemas"]["Position"] | null;
        };
        /**
         * Holds
         * @description `subject relation object`
         */
        Holds: {
            /** @enum {unknown} */
            type: "holds";
            subject: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
            relation: string;
            object: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
        };
        /**
         * Variable
         * @description A parameter, let, loop variable, output or quantified variable in scope.
         */
        Variable: {
            /** @enum {unknown} */
            type: "variable";
            name: string;
        };
        /**
         * Individual
         * @description A named individual of the world.
         */
        Individual: {
            /** @enum {unknown} */
            type: "individual";
            iri: string;
        };
        /**
         * Anything
         * @description `_`: any individual.
         */
        Anything: {
            /** @enum {unknown} */
            type: "anything";
        };
        /**
         * Compare
         * @description `left operator right` on data values; false when a property read on either side is missing.
         */
        Compare: {
            /** @enum {unknown} */
            type: "compare";
            left: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            /** @enum {unknown} */
            operator: "!=" | "<" | "<=" | "==" | ">" | ">=";
            right: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
        };
        /**
         * Literal
         * @description A constant; numbers in SI units, enumeration values as text.
         */
        Literal: {
            /** @enum {unknown} */
            type: "literal";
            value: boolean | number | string;
        };
        /**
         * PropertyOf
         * @description The value of a data property (stored or computed) of an individual, or the one thing of a functional relation.
         */
        PropertyOf: {
            /** @enum {unknown} */
            type: "property";
            of: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            property: string;
        };
        /**
         * Arithmetic
         * @description `left operator right` on numbers, or vectors where the types allow it.
         */
        Arithmetic: {
            /** @enum {unknown} */
            type: "arithmetic";
            /** @enum {unknown} */
            operator: "*" | "+" | "-" | "/";
            left: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            right: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
        };
        /**
         * Invoke
         * @description A vocabulary function applied to values.
         */
        Invoke: {
            /** @enum {unknown} */
            type: "invoke";
            function: string;
            arguments: (components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"])[];
        };
        /**
         * ListValue
         * @description A list of these values.
         */
        ListValue: {
            /** @enum {unknown} */
            type: "list";
            items: (components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"])[];
        };
        /**
         * Aggregate
         * @description A number, or a list, of the individuals of a class of which a condition holds.
         *
         *         `count` is how many there are; `sum`, `min`, `max` and `mean` are of the value of each. Of no individual, the last
         *         three have no value. `ordered` is the list of them in the order of their values; equal ones in that of IRIs.
         */
        Aggregate: {
            /** @enum {unknown} */
            type: "aggregate";
            /** @enum {unknown} */
            function: "count" | "max" | "mean" | "min" | "ordered" | "sum";
            variable: string;
            cls: string;
            where: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            value: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
        };
        /**
         * Same
         * @description Both terms are the same individual.
         */
        Same: {
            /** @enum {unknown} */
            type: "same";
            left: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
            right: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
        };
        /**
         * HasProperty
         * @description The individual has a value for the property.
         */
        HasProperty: {
            /** @enum {unknown} */
            type: "has";
            subject: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
            property: string;
        };
        /**
         * IsA
         * @description The individual is of the class or of a subclass.
         */
        IsA: {
            /** @enum {unknown} */
            type: "is";
            subject: components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["Anything"];
            cls: string;
        };
        /**
         * Given
         * @description The optional parameter was passed.
         */
        Given: {
            /** @enum {unknown} */
            type: "given";
            parameter: string;
        };
        /**
         * Not
         * @description The body does not hold.
         */
        Not: {
            /** @enum {unknown} */
            type: "not";
            body: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
        };
        /**
         * And
         * @description All parts hold; true when empty.
         */
        And: {
            /** @enum {unknown} */
            type: "and";
            parts: (components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"])[];
        };
        /**
         * Or
         * @description Some part holds; false when empty. `a implies b` is `not a or b`.
         */
        Or: {
            /** @enum {unknown} */
            type: "or";
            parts: (components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"])[];
        };
        /**
         * Exists
         * @description The body holds for some individual of the class.
         */
        Exists: {
            /** @enum {unknown} */
            type: "exists";
            variable: string;
            cls: string;
            body: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
        };
        /**
         * Forall
         * @description The body holds for every individual of the class.
         */
        Forall: {
            /** @enum {unknown} */
            type: "forall";
            variable: string;
            cls: string;
            body: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
        };
        /**
         * Message
         * @description A text with values: `{name}` in it stands for one of them, and braces stand twice.
         */
        Message: {
            /** @enum {unknown} */
            type: "message";
            text: string;
            values: components["schemas"]["NamedValue"][];
        };
        /**
         * NamedValue
         * @description A value in a text, by its name; `type` is None if it is not known.
         */
        NamedValue: {
            name: string;
            value: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            type: (components["schemas"]["ClassType"] | components["schemas"]["NumberType"] | components["schemas"]["VectorType"] | components["schemas"]["DirectionType"] | components["schemas"]["PlainType"] | components["schemas"]["ListType"]) | null;
        };
        /**
         * ClassType
         * @description An individual of an ontology class, given by IRI.
         */
        ClassType: {
            /** @enum {unknown} */
            type: "class";
            iri: string;
        };
        /**
         * NumberType
         * @description A number in SI units; `dimension` is a name of the language (`Force`), `Number` without one.
         */
        NumberType: {
            /** @enum {unknown} */
            type: "number";
            dimension: string;
        };
        /**
         * VectorType
         * @description Three numbers of one dimension in the world frame; `Number` if dimensionless.
         */
        VectorType: {
            /** @enum {unknown} */
            type: "vector";
            dimension: string;
        };
        /**
         * DirectionType
         * @description A unit vector in the world frame.
         */
        DirectionType: {
            /** @enum {unknown} */
            type: "direction";
        };
        /**
         * PlainType
         * @description `Bool`, `Int`, `Text`, `Message` or `Pose`; a message is a text, in which values are read where it is written.
         */
        PlainType: {
            /** @enum {unknown} */
            type: "plain";
            /** @enum {unknown} */
            name: "Bool" | "Int" | "Message" | "Pose" | "Text";
        };
        /**
         * ListType
         * @description `[T]`
         */
        ListType: {
            /** @enum {unknown} */
            type: "list";
            element: components["schemas"]["ClassType"] | components["schemas"]["NumberType"] | components["schemas"]["VectorType"] | components["schemas"]["DirectionType"] | components["schemas"]["PlainType"] | components["schemas"]["ListType"];
        };
        /**
         * Sequence
         * @description Runs its children in order until one fails; with memory unless reactive.
         */
        Sequence: {
            /** @enum {unknown} */
            type: "seq";
            children: (components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"])[];
            reactive: boolean;
            source: components["schemas"]["Position"];
        };
        /**
         * Selector
         * @description Runs its children in order until one succeeds; with memory unless reactive.
         */
        Selector: {
            /** @enum {unknown} */
            type: "sel";
            children: (components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"])[];
            reactive: boolean;
            source: components["schemas"]["Position"];
        };
        /**
         * Parallel
         * @description Runs its children together until `all` succeed, `any` succeeds, one ends (`race`) or the first ends (`lead`).
         *
         *         In a body of a plan, with `all`, a child may have to wait for others: `after` has their indices, for each child.
         */
        Parallel: {
            /** @enum {unknown} */
            type: "par";
            /** @enum {unknown} */
            policy: "all" | "any" | "lead" | "race";
            children: (components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"])[];
            source: components["schemas"]["Position"];
            /** @default [] */
            after?: number[][];
        };
        /**
         * Retry
         * @description Runs the child up to `count` times until it succeeds.
         */
        Retry: {
            /** @enum {unknown} */
            type: "retry";
            count: number | (components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"]);
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Repeat
         * @description Runs the child `count` times, as long as it succeeds.
         */
        Repeat: {
            /** @enum {unknown} */
            type: "repeat";
            count: number | (components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"]);
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Timeout
         * @description Runs the child; halts it and fails after `seconds`.
         */
        Timeout: {
            /** @enum {unknown} */
            type: "timeout";
            seconds: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Try
         * @description Runs the child and succeeds even if it fails, unless an enclosing hold condition breaks or the node is halted.
         */
        Try: {
            /** @enum {unknown} */
            type: "try";
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Invert
         * @description Runs the child and exchanges success and failure.
         */
        Invert: {
            /** @enum {unknown} */
            type: "invert";
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Once
         * @description Runs the child at most once per run of the enclosing skill; returns its result afterwards.
         */
        Once: {
            /** @enum {unknown} */
            type: "once";
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Wait
         * @description Waits for `seconds`, then succeeds.
         */
        Wait: {
            /** @enum {unknown} */
            type: "wait";
            seconds: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            source: components["schemas"]["Position"];
        };
        /**
         * WaitUntil
         * @description Waits until the condition holds, then succeeds.
         */
        WaitUntil: {
            /** @enum {unknown} */
            type: "wait-until";
            condition: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            text: string;
            source: components["schemas"]["Position"];
        };
        /**
         * If
         * @description Runs one of two branches, chosen at the start; without `orelse` a false condition succeeds.
         */
        If: {
            /** @enum {unknown} */
            type: "if";
            condition: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            text: string;
            then: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            orelse: (components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"]) | null;
            source: components["schemas"]["Position"];
        };
        /**
         * While
         * @description Repeats the child while the condition holds; fails if it still holds after `limit` rounds.
         */
        While: {
            /** @enum {unknown} */
            type: "while";
            condition: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            text: string;
            limit: number | (components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"]);
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * ForEach
         * @description Runs the child once for each item, in order.
         */
        ForEach: {
            /** @enum {unknown} */
            type: "for";
            variable: string;
            items: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Check
         * @description Succeeds if the condition holds, fails otherwise.
         */
        Check: {
            /** @enum {unknown} */
            type: "check";
            condition: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            text: string;
            source: components["schemas"]["Position"];
        };
        /**
         * Fail
         * @description Fails for a reason.
         */
        Fail: {
            /** @enum {unknown} */
            type: "fail";
            reason: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            source: components["schemas"]["Position"];
        };
        /**
         * Apply
         * @description Applies the labelled postconditions of the enclosing skill to the world model.
         */
        Apply: {
            /** @enum {unknown} */
            type: "apply";
            labels: string[];
            source: components["schemas"]["Position"];
        };
        /**
         * Call
         * @description Runs another skill; arguments are by parameter name, `out` is the local name of its output.
         */
        Call: {
            /** @enum {unknown} */
            type: "call";
            skill: string;
            implementation: string | null;
            arguments: {
                [key: string]: components["schemas"]["Literal"] | components["schemas"]["Variable"] | components["schemas"]["Individual"] | components["schemas"]["PropertyOf"] | components["schemas"]["Arithmetic"] | components["schemas"]["Invoke"] | components["schemas"]["ListValue"] | components["schemas"]["Aggregate"] | components["schemas"]["Message"];
            };
            out: string | null;
            source: components["schemas"]["Position"];
        };
        /**
         * With
         * @description Runs a scoped skill, then the child; the skill's setup is undone however the child ends.
         */
        With: {
            /** @enum {unknown} */
            type: "with";
            call: components["schemas"]["Call"];
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * OnFailure
         * @description Runs the child; if it fails, `handler` decides, in which `why` is the reason as text; None if it has no name.
         *
         *         `why.kind`, `why.message`, `why.skill` and `why.source` are variables of these names.
         */
        OnFailure: {
            /** @enum {unknown} */
            type: "on-failure";
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            why: string | null;
            handler: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * Finally
         * @description Runs the child, then `last` once the child has succeeded or failed; ends as the child does.
         */
        Finally: {
            /** @enum {unknown} */
            type: "finally";
            child: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            last: components["schemas"]["Sequence"] | components["schemas"]["Selector"] | components["schemas"]["Parallel"] | components["schemas"]["Retry"] | components["schemas"]["Repeat"] | components["schemas"]["Timeout"] | components["schemas"]["Try"] | components["schemas"]["Invert"] | components["schemas"]["Once"] | components["schemas"]["Wait"] | components["schemas"]["WaitUntil"] | components["schemas"]["If"] | components["schemas"]["While"] | components["schemas"]["ForEach"] | components["schemas"]["Check"] | components["schemas"]["Fail"] | components["schemas"]["Apply"] | components["schemas"]["Call"] | components["schemas"]["With"] | components["schemas"]["OnFailure"] | components["schemas"]["Finally"];
            source: components["schemas"]["Position"];
        };
        /**
         * TaskPart
         * @description One of several tasks that are planned and run as one: its goal, and within which time in s it is to hold.
         */
        TaskPart: {
            name: string;
            goal: components["schemas"]["Holds"] | components["schemas"]["Compare"] | components["schemas"]["Same"] | components["schemas"]["HasProperty"] | components["schemas"]["IsA"] | components["schemas"]["Given"] | components["schemas"]["Not"] | components["schemas"]["And"] | components["schemas"]["Or"] | components["schemas"]["Exists"] | components["schemas"]["Forall"];
            /** @default null */
            within_s?: number | null;
        };
        /**
         * RunSpec
         * @description All that a run is given: what is to be done, how, in which cell, and what is written of it.
         */
        RunSpec: {
            /**
             * @description The name of a task.
             * @default null
             */
            task?: string | null;
            /**
             * @description The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`.
             * @default {}
             */
            arguments?: {
                [key: string]: string;
            };
            /**
             * @description Instead of a task: plan for this goal, a condition, PDDL or JSON.
             * @default null
             */
            goal?: string | null;
            /**
             * @description Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`.
             * @default null
             */
            call?: string | null;
            /**
             * @description Look whether the arms can carry out a plan, before anything moves.
             * @default true
             */
            geometry?: boolean;
            /**
             * @description Let each plan, also a new one, wait for approval.
             * @default false
             */
            approve?: boolean;
            /**
             * @description Let a failed step wait for a decision instead of another plan.
             * @default false
             */
            ask_after_failure?: boolean;
            /**
             * @description Let the task fail if it has not ended after these seconds of the cell's time; also limits planning.
             * @default null
             */
            deadline_s?: number | null;
            /**
             * @description Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those that it was paused.
             * @default null
             */
            step_deadline_s?: number | null;
            /**
             * @description Pause before the first call, and go on step by step.
             * @default false
             */
            step?: boolean;
            /**
             * @description Pause before each call of a skill, or before the calls in a line.
             * @default []
             */
            breakpoints?: string[];
            /**
             * @description Pause before each step, with the arms held, until somebody lets the task go on.
             * @default false
             */
            confirm_steps?: boolean;
            /**
             * @description Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are.
             * @default 1
             */
            speed?: number;
            /**
             * @description Of those that wait for planners or devices, the higher comes first; nothing that runs gives way.
             * @default 0
             */
            priority?: number;
            /**
             * @description The scene of a goal or a call.
             * @default null
             */
            scene?: string | null;
            /**
             * @description The library of a goal or a call; by default that here, or `wiping`.
             * @default null
             */
            library?: string | null;
            /**
             * @description Another task of the same library and scene, to plan and run as one with TASK, which has precedence.
             * @default []
             */
            beside?: string[];
            /**
             * @description Let neither the plan nor the run break this condition, besides what the task says holds always.
             * @default []
             */
            always?: string[];
            /**
             * @description Minimise the total duration of all steps (`work`), the time until the last one ends, or the total cost. By default as the task or else its project says, and `work` if none does.
             * @default null
             */
            minimise?: ("cost" | "makespan" | "work") | null;
            /**
             * @description Reuse plans that were found for the same problem.
             * @default true
             */
            plan_cache?: boolean;
            /**
             * @description The seed of what differs from the world model.
             * @default 0
             */
            seed?: number;
            /**
             * @description How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`. By default as the scene says, ideal if it says nothing.
             * @default null
             */
            reality?: string | null;
            /**
             * @description Simulate with physics (`mujoco`), with ideal motion and contact (`kinematic`): faster, but contact is not verified then; or with facts alone (`symbolic`). Others run on robots. By default as the task or else its project says, and `mujoco` if none does.
             * @default null
             */
            backend?: string | null;
            /**
             * @description Move nothing: look where the devices are, begin there in simulation, and record what would be sent.
             * @default false
             */
            dry?: boolean;
            /**
             * @description Let simulated time pass as fast as it computes, or at most N times as fast as real time.
             * @default fast
             */
            pace?: number | string;
            /**
             * @description Write report.html, result.json, events.jsonl, figures, the film and stills to this folder.
             * @default null
             */
            out?: string | null;
            /**
             * @description Record forces, poses, joints and references, 100 samples a second, to the folder of the report.
             * @default null
             */
            signals?: ("csv" | "parquet") | null;
            /**
             * @description Write a film and stills with the report; another process makes them.
             * @default true
             */
            film?: boolean;
            /**
             * @description The quality of the film: small and without shadows, 960 x 540 pixels, or 1280 x 720, which takes longer.
             * @default standard
             * @enum {unknown}
             */
            film_quality?: "draft" | "fine" | "standard";
            /**
             * @description Write film.gif as well, a film of at most 4 MB that repeats.
             * @default false
             */
            gif?: boolean;
            /**
             * @description The appearance of devices in films: `primitive` shapes, or `menagerie` meshes (downloaded once).
             * @default primitive
             */
            looks?: string;
        };
        /**
         * StateChanged
         * @description The task run is in another state, and why; its end is a `TaskEnded`.
         *
         *         `failure` is that of a step if somebody has to decide how to go on after it. `contact` is what becomes of a tool
         *         that pressed when the run was paused: if only that changes, the state is the one before.
         */
        StateChanged: {
            /** @enum {unknown} */
            type: "state-changed";
            time: number;
            state: ("paused" | "pausing" | "planned" | "planning" | "queued" | "running" | "stopping") | ("failed" | "interrupted" | "stopped" | "succeeded");
            /** @default  */
            reason?: string;
            /** @default null */
            failure?: components["schemas"]["Failure"] | null;
            /**
             * @default none
             * @enum {unknown}
             */
            contact?: "approaching" | "kept" | "lifting" | "none" | "taken-off";
        };
        /**
         * Requested
         * @description A command was requested and took effect in a tick of the cell's loop; `refused` is why it changed nothing.
         */
        Requested: {
            /** @enum {unknown} */
            type: "requested";
            time: number;
            command: components["schemas"]["Approve"] | components["schemas"]["PauseRun"] | components["schemas"]["Resume"] | components["schemas"]["StepInto"] | components["schemas"]["StepOver"] | components["schemas"]["StepOut"] | components["schemas"]["Stop"] | components["schemas"]["Abort"] | components["schemas"]["RetryStep"] | components["schemas"]["Skip"] | components["schemas"]["Replan"] | components["schemas"]["AnswerPrompt"] | components["schemas"]["SetBreakpoints"] | components["schemas"]["EditWorld"];
            tick: number;
            /** @default  */
            refused?: string;
        };
        /**
         * Stop
         * @description Halt everything, and end when everything is at rest; `at_once` because the program ends.
         */
        Stop: {
            /** @enum {unknown} */
            type: "stop";
            /** @default stopped */
            reason?: string;
            /** @default false */
            at_once?: boolean;
            /** @default  */
            who?: string;
        };
        /**
         * Abort
         * @description Halt everything and fail, because devices have stopped by themselves; it is given by the cell, in any state.
         */
        Abort: {
            /** @enum {unknown} */
            type: "abort";
            reason: string;
            /** @default  */
            who?: string;
        };
        /**
         * EditWorld
         * @description Change the world model in one transaction.
         */
        EditWorld: {
            /** @enum {unknown} */
            type: "edit-world";
            changes: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["IndividualAdded"] | components["schemas"]["IndividualRemoved"])[];
            why: string;
            /** @default  */
            who?: string;
        };
        /**
         * LabelledRelation
         * @description A relation holds between two individuals, or does not; None stands for any individual.
         */
        LabelledRelation: {
            /** @enum {unknown} */
            type: "relation";
            subject: components["schemas"]["LabelledIri"] | null;
            relation: components["schemas"]["LabelledIri"];
            object: components["schemas"]["LabelledIri"] | null;
            /** @default true */
            holds?: boolean;
        };
        /**
         * IndividualAdded
         * @description An individual was added.
         */
        IndividualAdded: {
            /** @enum {unknown} */
            type: "added";
            individual: components["schemas"]["LabelledIri"];
            classes: components["schemas"]["LabelledIri"][];
        };
        /**
         * IndividualRemoved
         * @description An individual and all facts about it were removed.
         */
        IndividualRemoved: {
            /** @enum {unknown} */
            type: "removed";
            individual: components["schemas"]["LabelledIri"];
        };
        /**
         * Disturbed
         * @description Something happened to the simulated cell before a tick of its loop that no skill did; `who` wanted it.
         */
        Disturbed: {
            /** @enum {unknown} */
            type: "disturbed";
            time: number;
            disturbance: components["schemas"]["PushArm"] | components["schemas"]["MoveThing"] | components["schemas"]["TakeThing"] | components["schemas"]["PressEmergencyStop"] | components["schemas"]["LoseArm"];
            tick: number;
            /** @default  */
            who?: string;
        };
        /**
         * PlanArrived
         * @description The answer of a planner took effect in a tick of the cell's loop: a plan, or why there is none.
         *
         *         Neither if there was nothing to plan and the body that was given passed its checks. `detail` is what there is to say
         *         besides; `proved` if there is no plan, rather than that none was found. `space` is what is known in space of a body
         *         that was given.
         */
        PlanArrived: {
            /** @enum {unknown} */
            type: "plan-arrived";
            time: number;
            tick: number;
            /** @default null */
            plan?: components["schemas"]["ArrivedPlan"] | null;
            /** @default  */
            refused?: string;
            /** @default  */
            detail?: string;
            /** @default false */
            proved?: boolean;
            /** @default null */
            space?: components["schemas"]["SpaceClaim"] | null;
        };
        /**
         * ArrivedPlan
         * @description A plan as the planner found it, with its steps in order.
         *
         *         `arrangement` has each step, by its index in `steps`, where it runs in the body; `space` is what is known of it in
         *         space, None if nobody has looked. A policy goes on with one of its `branches`. The other fields are those
         *         of `Solved` in `planning.plan`.
         */
        ArrivedPlan: {
            planner: string;
            optimal: string;
            duration_s: number;
            steps: components["schemas"]["PlanStep"][];
            /** @default [] */
            left_out?: components["schemas"]["PartLeftOut"][];
            /** @default null */
            at_least_s?: number | null;
            /** @default [] */
            assumptions?: string[];
            /**
             * @default {
             *       "parts": []
             *     }
             */
            arrangement?: components["schemas"]["StepGroup"];
            /** @default null */
            space?: components["schemas"]["SpaceClaim"] | null;
            /** @default [] */
            branches?: components["schemas"]["PlanBranch"][];
        };
        /**
         * PlanStep
         * @description A step of a plan: the skill, its arguments by parameter name, and what comes of it if the plan expects that.
         */
        PlanStep: {
            skill: string;
            arguments: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            /** @default null */
            source?: components["schemas"]["Position"] | null;
            /** @default  */
            outcome?: string;
        };
        /**
         * PartLeftOut
         * @description A part of a planning problem that was left out; see `LeftOut` in `planning.plan`.
         */
        PartLeftOut: {
            /** @enum {unknown} */
            kind: "chains" | "individuals" | "numbers" | "skills" | "steps";
            why: string;
            harmless: boolean;
        };
        /**
         * StepGroup
         * @description Parts of a plan that run in series, or in `parallel`: indices of steps, and other groups.
         *
         *         In parallel, a part may have to wait for others: `after` has their indices, for each part.
         */
        StepGroup: {
            parts: (number | components["schemas"]["StepGroup"])[];
            /** @default false */
            parallel?: boolean;
            /** @default [] */
            after?: number[][];
        };
        /**
         * SpaceClaim
         * @description How many steps of a plan go in space, of how many, and why the next does not; None if it does or is not known.
         *
         *         unseen: the calls in these steps that were not looked at. postures: those in which arms bring their tools to poses,
         *         in the order of the steps, which a run takes as well. apart: the steps that do not run at the same time, since arms
         *         would meet. stands: where bases stand beside where a place wants them. places: where things are put down, which a
         *         run does as well. implementations: the steps that are done with another one than the first that goes. ways: those of
         *         bases that are not straight. stopped: why the look ended before it was through; empty if it was. from_home: whether
         *         the arms begin at home; else where they were when the plan was made.
         */
        SpaceClaim: {
            checked: number;
            steps: number;
            /** @default [] */
            unseen?: components["schemas"]["UnseenCall"][];
            /** @default [] */
            postures?: components["schemas"]["ChosenPosture"][];
            /** @default [] */
            apart?: components["schemas"]["StepsApart"][];
            /** @default [] */
            stands?: components["schemas"]["StandAt"][];
            /** @default [] */
            places?: components["schemas"]["PlaceAt"][];
            /** @default [] */
            implementations?: components["schemas"]["ChosenImplementation"][];
            /** @default [] */
            ways?: components["schemas"]["WayAround"][];
            /** @default null */
            failure?: string | null;
            /** @default  */
            stopped?: string;
            /** @default true */
            from_home?: boolean;
        };
        /**
         * UnseenCall
         * @description A call, by the skills around it, of which nobody says what it needs of space, in a step of a plan, from 1.
         */
        UnseenCall: {
            step: number;
            what: string;
        };
        /**
         * ChosenPosture
         * @description The joints `q` (nv,) in rad with which an arm brings its tool to a pose, in a step of a plan, from 1.
         *
         *         `base` is where its base stands then; both poses are in the world. None in older recordings.
         */
        ChosenPosture: {
            step: number;
            arm: components["schemas"]["LabelledIri"];
            q: number[];
            tool: components["schemas"]["LabelledPose"];
            /** @default null */
            base?: components["schemas"]["LabelledPose"] | null;
        };
        /**
         * StepsApart
         * @description Two steps of a plan, from 1, that do not run at the same time: these arms or bases would come into one place.
         */
        StepsApart: {
            one: number;
            other: number;
            arms: [
                string,
                string
            ];
        };
        /**
         * StandAt
         * @description Where a base stands in a step of a plan, from 1: an arm does not get to its work where the place wants the base.
         *
         *         x_m, y_m, yaw_rad: in the frame of the place.
         */
        StandAt: {
            step: number;
            robot: components["schemas"]["LabelledIri"];
            place: components["schemas"]["LabelledIri"];
            x_m: number;
            y_m: number;
            yaw_rad: number;
        };
        /**
         * PlaceAt
         * @description Where a thing is put down at a place in a step of a plan, from 1: `at` is its pose as a tool, on a support.
         *
         *         That is in the frame of the support, which is the place, furniture in it, or a placing pose if it is stated. board:
         *         of a shelf, 0 for all else. middle_m: of the thing there, in the same frame; None in older recordings.
         */
        PlaceAt: {
            step: number;
            thing: components["schemas"]["LabelledIri"];
            place: components["schemas"]["LabelledIri"];
            support: components["schemas"]["LabelledIri"];
            at: components["schemas"]["LabelledPose"];
            /** @default 0 */
            board?: number;
            /** @default false */
            stated?: boolean;
            /** @default null */
            middle_m?: [
                number,
                number,
                number
            ] | null;
        };
        /**
         * ChosenImplementation
         * @description With which implementation a step of a plan, from 1, is tried first: after others a later step does not go.
         */
        ChosenImplementation: {
            step: number;
            skill: string;
            implementation: string;
        };
        /**
         * WayAround
         * @description The way of a base to a place in a step of a plan, from 1, that is not straight, since something is in that way.
         *
         *         corners_m: (x, y) in the world. A run looks for its way again, in the same way.
         */
        WayAround: {
            step: number;
            robot: components["schemas"]["LabelledIri"];
            place: components["schemas"]["LabelledIri"];
            corners_m: [
                number,
                number
            ][];
            around: components["schemas"]["LabelledIri"][];
        };
        /**
         * PlanBranch
         * @description How a policy goes on after an outcome of its last step, and how likely that is; see `Branch` in `planning.plan`.
         *
         *         `steps` is None if it is planned when the outcome comes. `duration_s` is the expected duration of the branch, in s.
         */
        PlanBranch: {
            outcome: string;
            likely: number;
            /** @default null */
            steps?: components["schemas"]["PlanStep"][] | null;
            /** @default 0 */
            duration_s?: number;
            /** @default [] */
            branches?: components["schemas"]["PlanBranch"][];
        };
        /**
         * PlanMade
         * @description A planner found a plan; `cost` is its expected duration in s.
         *
         *         `optimal` is the planner's claim, `quality` the same as text, with the problem for which it holds. `arrangement`,
         *         `space` and `branches` are as in `ArrivedPlan`.
         */
        PlanMade: {
            /** @enum {unknown} */
            type: "plan-made";
            time: number;
            planner: string;
            optimal: string;
            cost: number;
            steps: components["schemas"]["PlanStep"][];
            /** @default  */
            quality?: string;
            /**
             * @default {
             *       "parts": []
             *     }
             */
            arrangement?: components["schemas"]["StepGroup"];
            /** @default null */
            space?: components["schemas"]["SpaceClaim"] | null;
            /** @default [] */
            branches?: components["schemas"]["PlanBranch"][];
        };
        /**
         * PromptsChanged
         * @description Skills ask operators something else: these are all open prompts now.
         */
        PromptsChanged: {
            /** @enum {unknown} */
            type: "prompts-changed";
            time: number;
            prompts: components["schemas"]["Prompt"][];
        };
        /**
         * Replanned
         * @description The plan failed or no longer leads to the goal; the next plan replaces it.
         *
         *         Or a policy goes on after what was `sensed`: the next plan is its branch, made anew if that does not work.
         */
        Replanned: {
            /** @enum {unknown} */
            type: "replanned";
            time: number;
            reason: string;
            /** @default false */
            sensed?: boolean;
        };
        /**
         * NodeStarted
         * @description A node of the tree starts; `parent` is the id of its parent, 0 for the root.
         */
        NodeStarted: {
            /** @enum {unknown} */
            type: "node-started";
            time: number;
            node: number;
            parent: number;
            kind: string;
            name: string;
            source: components["schemas"]["Position"];
        };
        /**
         * NodeEnded
         * @description A node succeeded, failed or was halted; `failure` is the reason, `failed_call` the context of a failed call.
         *
         *         `outputs` are the values that a call has returned, by parameter name.
         */
        NodeEnded: {
            /** @enum {unknown} */
            type: "node-ended";
            time: number;
            node: number;
            name: string;
            status: string;
            /** @default null */
            failure?: components["schemas"]["Failure"] | null;
            /** @default null */
            failed_call?: components["schemas"]["FailedCallContext"] | null;
            /** @default {} */
            outputs?: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            source: components["schemas"]["Position"];
        };
        /**
         * FailedCallContext
         * @description The context of a failed call: its arguments, the rejected implementations, and the facts.
         *
         *         `unset` are the parameters that could not be inferred. `facts` are those that its conditions read, at the time of
         *         the failure.
         */
        FailedCallContext: {
            /** @default {} */
            arguments?: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            /** @default [] */
            unset?: string[];
            /** @default [] */
            rejected?: components["schemas"]["Rejection"][];
            /** @default [] */
            facts?: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"])[];
        };
        /**
         * Rejection
         * @description An implementation that was rejected, at which stage, and why.
         *
         *         `failure` is its failure if the implementation had started, now or in an earlier attempt.
         */
        Rejection: {
            implementation: string;
            /** @enum {unknown} */
            stage: "argument" | "hold" | "inference" | "lock" | "pre" | "run" | "start";
            reason: string;
            source: components["schemas"]["Position"];
            /** @default null */
            failure?: components["schemas"]["Failure"] | null;
        };
        /**
         * LabelledClass
         * @description An individual is of a class, or is not.
         */
        LabelledClass: {
            /** @enum {unknown} */
            type: "class";
            individual: components["schemas"]["LabelledIri"];
            cls: components["schemas"]["LabelledIri"];
            /** @default true */
            holds?: boolean;
        };
        /**
         * LabelledIdentity
         * @description Two names denote the same individual, or do not.
         */
        LabelledIdentity: {
            /** @enum {unknown} */
            type: "same";
            one: components["schemas"]["LabelledIri"];
            other: components["schemas"]["LabelledIri"];
            /** @default true */
            holds?: boolean;
        };
        /**
         * ImplementationChosen
         * @description A call starts with this implementation; `bindings` are its parameters.
         *
         *         `determined` are the reasons for the values that were not simply passed; `untried` are the implementations that
         *         rank after this one. `fixed` if the call names the implementation. `activity` is what a primitive declares to do,
         *         for example `press`; `highlights` are the moments of it to show. `expressions` are those of the arguments and
         *         defaults, by parameter; `out` is the name that gets the output.
         */
        ImplementationChosen: {
            /** @enum {unknown} */
            type: "implementation-chosen";
            time: number;
            node: number;
            skill: string;
            implementation: string;
            bindings: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            /** @default [] */
            rejected?: components["schemas"]["Rejection"][];
            /** @default [] */
            determined?: components["schemas"]["ParameterReason"][];
            /** @default [] */
            untried?: components["schemas"]["UntriedImplementation"][];
            /** @default false */
            fixed?: boolean;
            /** @default  */
            activity?: string;
            /** @default [] */
            highlights?: components["schemas"]["Highlight"][];
            /** @default {} */
            expressions?: {
                [key: string]: components["schemas"]["WrittenExpression"];
            };
            /** @default  */
            out?: string;
            source: components["schemas"]["Position"];
        };
        /**
         * ParameterReason
         * @description Why a parameter that is not simply an argument of the call has its value.
         *
         *         `how` is where the value comes from: the caller, the default, or inference from the conditions. `others` are the
         *         other individuals that `infer any` could have chosen.
         */
        ParameterReason: {
            parameter: string;
            /** @enum {unknown} */
            how: "default" | "inferred" | "passed";
            /** @default [] */
            conditions?: components["schemas"]["DecidingCondition"][];
            /** @default [] */
            others?: components["schemas"]["LabelledIri"][];
        };
        /**
         * DecidingCondition
         * @description A condition as written in the source, with the facts that decided it.
         */
        DecidingCondition: {
            text: string;
            source: components["schemas"]["Position"];
            facts: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"])[];
        };
        /**
         * UntriedImplementation
         * @description An implementation that ranks after the chosen one; `reason` is why it could not start, empty if it could.
         */
        UntriedImplementation: {
            implementation: string;
            source: components["schemas"]["Position"];
            /** @default  */
            reason?: string;
        };
        /**
         * Highlight
         * @description What `what` is, for example `pressed`, when a call begins or ends successfully: a moment to show in a report.
         */
        Highlight: {
            /** @enum {unknown} */
            when: "begins" | "ends";
            what: components["schemas"]["LabelledIri"];
            word: string;
        };
        /**
         * WrittenExpression
         * @description An expression as text in the syntax of the language, and where it stands.
         *
         *         `facts` are those that it reads, `names` the names of the enclosing body in it.
         */
        WrittenExpression: {
            text: string;
            source: components["schemas"]["Position"];
            /** @default [] */
            facts?: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"])[];
            /** @default [] */
            names?: components["schemas"]["NameInExpression"][];
        };
        /**
         * NameInExpression
         * @description A name of the enclosing body in an expression, and how it gets its value.
         *
         *         It is a `parameter` of the body, a `let` with its `expression`, an item of a `loop` over the `expression`, the
         *         `output` of a call, or `given` as an argument of the task. `value` is that of the argument or the item, if known.
         */
        NameInExpression: {
            name: string;
            /** @enum {unknown} */
            how: "given" | "let" | "loop" | "output" | "parameter";
            /** @default null */
            expression?: components["schemas"]["WrittenExpression"] | null;
            /** @default null */
            value?: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]) | null;
        };
        /**
         * WorldChanged
         * @description The world model changed; `known` is the evidence for the change, None for changes from outside the run.
         */
        WorldChanged: {
            /** @enum {unknown} */
            type: "world-changed";
            time: number;
            origin: string;
            changes: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["IndividualAdded"] | components["schemas"]["IndividualRemoved"])[];
            /** @default null */
            known?: ("assumed" | "idealised" | "reported" | "sensed") | null;
        };
        /**
         * Note
         * @description A message for users, without effect on the run.
         */
        Note: {
            /** @enum {unknown} */
            type: "note";
            time: number;
            message: string;
            /** @default 0 */
            node?: number;
            /** @default null */
            source?: components["schemas"]["Position"] | null;
        };
        /**
         * Paused
         * @description The run was paused.
         */
        Paused: {
            /** @enum {unknown} */
            type: "paused";
            time: number;
        };
        /**
         * Resumed
         * @description The run was resumed.
         */
        Resumed: {
            /** @enum {unknown} */
            type: "resumed";
            time: number;
        };
        /**
         * TaskEnded
         * @description A task ended in the state `status`; `facts` are those that its success rests on.
         *
         *         `verified` is whether none of them is only assumed, and no claim is false; None if the task did not succeed.
         *         `false_claims` are sentences about what the world model claims of things that is not so in the simulator.
         */
        TaskEnded: {
            /** @enum {unknown} */
            type: "task-ended";
            time: number;
            task: string;
            /** @enum {unknown} */
            status: "failed" | "interrupted" | "stopped" | "succeeded";
            /** @default null */
            failure?: components["schemas"]["Failure"] | null;
            /** @default null */
            verified?: boolean | null;
            /** @default [] */
            facts?: components["schemas"]["KnownFact"][];
            /** @default [] */
            false_claims?: string[];
        };
        /**
         * KnownFact
         * @description A fact and its evidence: `given` before the run, or established by the skill or device `by`.
         *
         *         `why` it is known no better, if `by` has said so. `with_physics`: what is idealised comes from a simulation with
         *         physics, in which it counts as verified.
         */
        KnownFact: {
            fact: components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"];
            /** @enum {unknown} */
            known: "assumed" | "given" | "idealised" | "reported" | "sensed";
            /** @default  */
            by?: string;
            /** @default  */
            why?: string;
            /** @default false */
            with_physics?: boolean;
        };
        /**
         * Order
         * @description An order of `owner`, and how far it is: `next_at` is when its next operation is due, null if there is none.
         *
         *         `operation` is the last one that was submitted; `reason` says why the last one that was due was not.
         */
        Order: {
            id: string;
            cell: string;
            owner: string;
            order: components["schemas"]["OrderRequest"];
            next_at: string | null;
            /** @default null */
            operation?: string | null;
            /** @default  */
            reason?: string;
        };
        /**
         * OrderRequest
         * @description An operation that is submitted `at` a time, or from then on again `every_s` s, `count` times or `until` a time.
         *
         *         One is missed if it could not be submitted within 60 s after it was due, because the server or the cell was off,
         *         another client had the lease, or the operation before had not ended. Of those that were missed the last one is
         *         submitted as soon as that is possible, or none (`skip`).
         */
        OrderRequest: {
            request: components["schemas"]["OperationRequest"];
            /** Format: date-time */
            at: string;
            /** @default null */
            every_s?: number | null;
            /** @default null */
            until?: string | null;
            /** @default null */
            count?: number | null;
            /**
             * @default run-once
             * @enum {unknown}
             */
            missed?: "run-once" | "skip";
        };
        /**
         * QueueOrder
         * @description The ids of the operations that come first among those that wait in a cell, in this order.
         */
        QueueOrder: {
            first: string[];
        };
        /**
         * OperationTree
         * @description The nodes of a run after its event `sequence`, each after its parent; later events start and end them.
         */
        OperationTree: {
            sequence: number;
            nodes: components["schemas"]["TreeNode"][];
        };
        /**
         * TreeNode
         * @description A node of a tree; the events about it have its `id`. `parent` is 0 for the root of an attempt.
         *
         *         `attempt` counts plans from 1. A call has a `skill`, with the `arguments` that a planner or the text has given it by
         *         name, and once it has started the `implementation` that it chose.
         */
        TreeNode: {
            id: number;
            parent: number;
            attempt: number;
            kind: string;
            label: string;
            source: components["schemas"]["Position"];
            /** @default  */
            skill?: string;
            /** @default  */
            implementation?: string;
            /** @default {} */
            arguments?: {
                [key: string]: string;
            };
        };
        /**
         * RunExplanation
         * @description Why a run, up to its event `sequence`, did what it did: `lines` as `skillc why` prints them, and each call.
         *
         *         `answer` has the lines for a question, none without. For a question about a parameter, `origins` says where its
         *         value comes from in each call that has one.
         */
        RunExplanation: {
            sequence: number;
            lines: string[];
            chain: components["schemas"]["ChainedFailure"][];
            calls: components["schemas"]["ExplainedCall"][];
            answer: string[];
            /** @default [] */
            origins?: components["schemas"]["ValueOrigin"][];
        };
        /**
         * ChainedFailure
         * @description A link of the chain that leads from the outermost call that failed to the cause, with its place.
         */
        ChainedFailure: {
            name: string;
            message: string;
            source: components["schemas"]["Position"];
        };
        /**
         * ExplainedCall
         * @description A call, explained as `skillc why RUN NUMBER` does, with those inside it after it.
         *
         *         `parameters` are those with values; the question `NUMBER.PARAMETER` asks where one comes from.
         *
         *         `node` is the one in the tree and the events, 0 if the call never started. `source` is the place of the call,
         *         `implementation_source` that of the implementation that it chose last.
         */
        ExplainedCall: {
            number: string;
            skill: string;
            status: string;
            lines: string[];
            /** @default 0 */
            node?: number;
            /** @default null */
            source?: components["schemas"]["Position"] | null;
            /** @default null */
            implementation_source?: components["schemas"]["Position"] | null;
            /** @default [] */
            parameters?: string[];
        };
        /**
         * ValueOrigin
         * @description Where the value of a name comes from, and below it the same for each name that it was computed from.
         *
         *         `call` is the number of the call of whose parameter or body it is a name, empty in a task. `how` is `passed` by the
         *         caller, `planned`, a `default`, `inferred`, a `let`, an item of a `loop`, the `output` of the call `by`, or `given`
         *         to the task. `text` and `source` are the expression, of an output its name and the place of the call. A value that
         *         was inferred fulfils the `conditions`; `others` are the individuals that `infer any` could have chosen as well.
         */
        ValueOrigin: {
            name: string;
            call: string;
            /** @enum {unknown} */
            how: "default" | "given" | "inferred" | "let" | "loop" | "output" | "passed" | "planned";
            /** @default null */
            value?: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]) | null;
            /** @default  */
            text?: string;
            /** @default null */
            source?: components["schemas"]["Position"] | null;
            /** @default  */
            by?: string;
            /** @default [] */
            facts?: components["schemas"]["LocatedFact"][];
            /** @default [] */
            conditions?: components["schemas"]["DecidingCondition"][];
            /** @default [] */
            others?: components["schemas"]["LabelledIri"][];
            /** @default [] */
            names?: components["schemas"]["ValueOrigin"][];
        };
        /**
         * LocatedFact
         * @description A fact that was read, and when and by what it was written, or else its `place` in the scene.
         */
        LocatedFact: {
            known: components["schemas"]["RecordedFact"];
            /** @default null */
            place?: components["schemas"]["Position"] | null;
        };
        /**
         * RecordedFact
         * @description A fact at one time; `since` and `by` are when and by what it was written, if that was during the run.
         *
         *         `known` is its evidence: sensed, reported or assumed; empty if unknown.
         */
        RecordedFact: {
            fact: components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"];
            /** @default null */
            since?: number | null;
            /** @default  */
            by?: string;
            /** @default  */
            known?: string;
        };
        /**
         * SignalRows
         * @description Signals at the times `time_s` of the cell; each of `signals` has its column in `columns`, null where unknown.
         *
         *         `every_s` is how far apart these rows are at least. `more` if there are later ones.
         */
        SignalRows: {
            time_s: number[];
            signals: components["schemas"]["Signal"][];
            columns: (number | null)[][];
            every_s: number;
            more: boolean;
        };
        /**
         * Signal
         * @description A column of samples: `DEVICE/ORIGIN/QUANTITY_UNIT`, with its unit and the frame of its axes, empty for none.
         *
         *         `device` is the IRI of the device or the thing, empty for the clock.
         */
        Signal: {
            column: string;
            device: string;
            /** @enum {unknown} */
            origin: "command" | "estimate" | "sensor" | "truth";
            unit: string;
            frame: string;
            description: string;
        };
        /**
         * RunDiff
         * @description The differences between two runs, in the order of their parts; `compared` is how much of each part there was.
         *
         *         `notes` say what could not be compared, and why.
         */
        RunDiff: {
            runs: [
                string,
                string
            ];
            compared: {
                [key: string]: number;
            };
            differences: components["schemas"]["Difference"][];
            /** @default [] */
            notes?: string[];
        };
        /**
         * Difference
         * @description `what` is not the same in two runs; a value is None where a run has none.
         *
         *         `size` orders the differences of a part: between numbers, how far they are apart, in s for times, and for signals in
         *         parts of their range; 0 where there is no order but that of the run.
         */
        Difference: {
            /** @enum {unknown} */
            part: "choices" | "measures" | "outcomes" | "plan" | "requests" | "settings" | "signals" | "times";
            what: string;
            first: string | number | boolean | null;
            second: string | number | boolean | null;
            /** @default 0 */
            size?: number;
        };
        /**
         * WorldFacts
         * @description Some of the `total` facts that were asked for, of the world after the write `sequence`.
         */
        WorldFacts: {
            sequence: number;
            total: number;
            facts: components["schemas"]["WorldFact"][];
        };
        /**
         * WorldFact
         * @description A fact, and how it is known: `evidence` is None for what the scene or a person stated, and by whom or what.
         */
        WorldFact: {
            fact: components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["LabelledClass"] | components["schemas"]["LabelledIdentity"];
            /** @default null */
            evidence?: ("assumed" | "idealised" | "reported" | "sensed") | null;
            /** @default  */
            origin?: string;
        };
        /**
         * WorldText
         * @description A world after the write `sequence`, as text.
         */
        WorldText: {
            sequence: number;
            text: string;
        };
        /**
         * StatableFacts
         * @description The terms of facts about a thing; `things` are the individuals of each class that `objects` of a term names.
         */
        StatableFacts: {
            terms: components["schemas"]["StatableTerm"][];
            things: {
                [key: string]: string[];
            };
        };
        /**
         * StatableTerm
         * @description A relation or property that facts about a thing may have, and how such a fact is written.
         *
         *         `type` is the type of the value in the language, such as `Force` or `Text`; of a relation, the classes of its
         *         objects. Numbers are in `unit`. `values` are the possible texts, if they are limited. A new fact about a
         *         `functional` term replaces the former one.
         */
        StatableTerm: {
            iri: string;
            name: string;
            /** @enum {unknown} */
            kind: "property" | "relation";
            type: string;
            unit: string;
            values: string[];
            objects: string[];
            functional: boolean;
            doc: string;
        };
        /**
         * PlacedThing
         * @description A thing: name, classes, what its pose is stated relative to, pose in the world in m and degrees, size in m.
         *
         *         `problem` says why its pose is not known; then position and angles are empty.
         */
        PlacedThing: {
            name: string;
            classes: string[];
            stated: string;
            position: number[];
            angles: number[];
            size: number[];
            /** @default null */
            problem?: string | null;
        };
        /**
         * QueryRows
         * @description The answer to a query, of the world after the write `sequence`; `truncated` if there were more rows.
         */
        QueryRows: {
            sequence: number;
            columns: string[];
            rows: (string | boolean | number | null)[][];
            /** @default false */
            truncated?: boolean;
        };
        /**
         * WorldQuery
         * @description A SPARQL query, SELECT, ASK or CONSTRUCT; the prefixes of the vocabulary are declared.
         */
        WorldQuery: {
            sparql: string;
        };
        /**
         * WorldEdit
         * @description Changes that are made together or not at all, and why.
         *
         *         Each is a fact in the syntax in which facts are shown, such as `lab:Board-1.isClean == true`. `not` before a fact
         *         removes it, and `not INDIVIDUAL` removes all facts about an individual. Statements of Turtle are taken, too.
         */
        WorldEdit: {
            edits: string[];
            why: string;
        };
        /**
         * WorldPlacement
         * @description Where a thing is, and why this is said: its position in m and a quaternion (w, x, y, z), in the world.
         *
         *         It stays with what carries it. `thing` is an IRI or `prefix:name`.
         */
        WorldPlacement: {
            thing: string;
            pose: [
                number,
                number,
                number,
                number,
                number,
                number,
                number
            ];
            why: string;
        };
        /**
         * WorldWrite
         * @description A write to the world: its number, when it was made, who or what made it, how that is known, and the changes.
         *
         *         `written_ns` is the wall time in ns since 1970, 0 if it is not known; `evidence` is None for what a person states.
         *         `undo` are the changes that lead back to the world before.
         */
        WorldWrite: {
            sequence: number;
            written_ns: number;
            origin: string;
            evidence: ("assumed" | "idealised" | "reported" | "sensed") | null;
            changes: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["IndividualAdded"] | components["schemas"]["IndividualRemoved"])[];
            /** @default [] */
            undo?: (components["schemas"]["LabelledRelation"] | components["schemas"]["LabelledProperty"] | components["schemas"]["IndividualAdded"] | components["schemas"]["IndividualRemoved"])[];
        };
        /**
         * VersionInfo
         * @description The version of skillc, and that of the API.
         */
        VersionInfo: {
            skillc: string;
            api: string;
        };
        /**
         * LibraryStatus
         * @description A library, and the cells whose next operations run it.
         *
         *         `problem` is why that is not the one on disk; empty if it is. `pending` if its files have changed, and were not
         *         checked yet.
         */
        LibraryStatus: {
            name: string;
            hash: string;
            problem: string;
            cells: string[];
            /** @default false */
            pending?: boolean;
        };
        /**
         * LibraryDescription
         * @description A compiled library; `hash` identifies its content.
         */
        LibraryDescription: {
            name: string;
            hash: string;
            skills: components["schemas"]["SkillDescription"][];
            tasks: components["schemas"]["TaskDescription"][];
        };
        /**
         * SkillDescription
         * @description A skill: its conditions as they are written, and its implementations in the order in which they are tried.
         *
         *         `duration_s` is the duration that it declares; None if it declares none, or one that depends on its parameters.
         */
        SkillDescription: {
            name: string;
            doc: string;
            parameters: components["schemas"]["ParameterDescription"][];
            pre: string[];
            post: string[];
            implementations: components["schemas"]["ImplementationDescription"][];
            /** @default null */
            duration_s?: number | null;
        };
        /**
         * ParameterDescription
         * @description A parameter: a caller gives it (`in`), may give it (`opt`), or it is found (`infer`) or returned (`out`).
         *
         *         `type` is as in the language.
         */
        ParameterDescription: {
            name: string;
            /** @enum {unknown} */
            direction: "in" | "infer" | "opt" | "out";
            type: string;
            doc: string;
        };
        /**
         * ImplementationDescription
         * @description An implementation of a skill; `pre` are the conditions that it adds.
         */
        ImplementationDescription: {
            name: string;
            doc: string;
            pre: string[];
        };
        /**
         * TaskDescription
         * @description A task; `goal` is empty for one with a body.
         */
        TaskDescription: {
            name: string;
            doc: string;
            parameters: components["schemas"]["ParameterDescription"][];
            goal: string;
        };
        /**
         * DeviceStatus
         * @description A device, and the operation that holds it; null if it is free.
         *
         *         `control` is the report of the process that controls a real arm, at most a second old; null without one.
         */
        DeviceStatus: {
            device: components["schemas"]["Device"];
            held_by: string | null;
            /** @default null */
            control?: components["schemas"]["ControlReport"] | null;
        };
        /**
         * Device
         * @description A device: its IRI, its short name (`label`), its classes, and the device that it is part of.
         *
         *         `figures` are those of its data sheet, `controller` is that of an arm.
         */
        Device: {
            iri: string;
            label: string;
            /** @enum {unknown} */
            kind: "arm" | "base" | "camera" | "gripper" | "robot" | "sensor";
            types: string[];
            part_of: string | null;
            controller: string | null;
            figures: components["schemas"]["SheetFigure"][];
        };
        /**
         * SheetFigure
         * @description What a data sheet states: `property` is its short name; `unit` is that of the SI, empty without one.
         */
        SheetFigure: {
            property: string;
            value: string | boolean | number;
            unit: string;
        };
        /**
         * ControlReport
         * @description The state of an arm's device, with a sentence about what keeps it from moving, and its control periods.
         *
         *         name: the short name of the arm. period_s: the nominal control period. rate_hz: control periods a second, and
         *         late_s: by how much the latest of them began late, both in the last seconds; None while there is none. lost_periods:
         *         those without a command or a state so far. speed_share: at which share of the commanded speeds the device moves, by
         *         its speed slider; 1 without. real_time: whether the process runs before all others of its machine.
         */
        ControlReport: {
            name: string;
            /** @enum {unknown} */
            state: "emergency-stop" | "in-control" | "lost" | "not-in-control" | "protective-stop" | "ready" | "wrong-mode";
            sentence: string;
            period_s: number;
            rate_hz: number | null;
            late_s: number | null;
            lost_periods: number;
            speed_share: number;
            real_time: boolean;
        };
        /**
         * Job
         * @description A job: what is requested by whom, in which cell, and how far it is: `done` of `wanted` parts, `failed` of these.
         *
         *         `reason` is why it is in its state, empty if that is clear; `problem` says more of one that has failed, as a refusal
         *         of a request does. One is `interrupted` if the server has ended before. `files` are the names of what it has left.
         */
        Job: {
            id: string;
            cell: string;
            owner: string;
            request: components["schemas"]["PlanRequest"] | components["schemas"]["RehearsalRequest"] | components["schemas"]["TrialsRequest"] | components["schemas"]["TrialReplayRequest"] | components["schemas"]["ReportRequest"] | components["schemas"]["LearnRequest"];
            /**
             * @default waiting
             * @enum {unknown}
             */
            state?: "cancelled" | "ended" | "failed" | "interrupted" | "running" | "waiting";
            /** @default  */
            reason?: string;
            /** @default null */
            problem?: components["schemas"]["ProblemDetails"] | null;
            /** @default 0 */
            done?: number;
            /** @default 0 */
            failed?: number;
            /** @default 1 */
            wanted?: number;
            /** @default [] */
            files?: string[];
        };
        /**
         * PlanRequest
         * @description A task of a cell's library with arguments, or a goal as a condition or as PDDL, to plan for.
         *
         *         `cell` may be left out if there is only one, and `minimise` for what the task says, or else work. `prove` searches
         *         until the least work is proved; the search ends after `deadline_s` s. With `geometry` plans are looked at in space,
         *         from where the arms are.
         */
        PlanRequest: {
            /** @enum {unknown} */
            kind: "plan";
            /** @default null */
            cell?: string | null;
            /** @default null */
            task?: string | null;
            /** @default null */
            goal?: string | null;
            /** @default {} */
            arguments?: {
                [key: string]: string;
            };
            /** @default null */
            minimise?: ("cost" | "makespan" | "work") | null;
            /** @default false */
            prove?: boolean;
            /** @default 30 */
            deadline_s?: number;
            /** @default true */
            geometry?: boolean;
        };
        /**
         * RehearsalRequest
         * @description A task of a cell's library with arguments, a goal, or a call of a skill, to try in a simulated twin of the cell.
         *
         *         `cell` may be left out if there is only one. Nobody can be asked: a question is answered at once, by the first of
         *         `answers` that is a choice, else by its default; without either the rehearsal ends there. It is filmed with `film`,
         *         and recorded with `record`.
         */
        RehearsalRequest: {
            /** @enum {unknown} */
            kind: "rehearsal";
            /**
             * @description The name of a task.
             * @default null
             */
            task?: string | null;
            /**
             * @description The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`.
             * @default {}
             */
            arguments?: {
                [key: string]: string;
            };
            /**
             * @description Instead of a task: plan for this goal, a condition, PDDL or JSON.
             * @default null
             */
            goal?: string | null;
            /**
             * @description Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`.
             * @default null
             */
            call?: string | null;
            /** @default null */
            cell?: string | null;
            /**
             * @description Determines how the twin differs from what is known.
             * @default 0
             */
            seed?: number;
            /**
             * @description Let the task fail if it has not ended after these seconds of the twin's time.
             * @default 600
             */
            deadline_s?: number;
            /**
             * @description Look whether the arms can carry out a plan, before anything moves.
             * @default true
             */
            geometry?: boolean;
            /**
             * @description Answer what skills ask with this choice, where it is one.
             * @default []
             */
            answers?: string[];
            /** @default false */
            film?: boolean;
            /** @default false */
            record?: boolean;
        };
        /**
         * TrialsRequest
         * @description A task of a cell's library with arguments, to run `number` times from the cell's scene, with seeds from `seed`.
         *
         *         `cell` may be left out if there is only one. `disturb` is what disturbs each trial; one may take `deadline_s` s of
         *         wall time.
         */
        TrialsRequest: {
            /** @enum {unknown} */
            kind: "trials";
            /** @default null */
            cell?: string | null;
            task: string;
            /** @default {} */
            arguments?: {
                [key: string]: string;
            };
            /** @default 50 */
            number?: number;
            /** @default 0 */
            seed?: number;
            /**
             * @default none
             * @enum {unknown}
             */
            disturb?: "missing" | "none" | "obstacle" | "push" | "take";
            /** @default 3600 */
            deadline_s?: number;
        };
        /**
         * TrialReplayRequest
         * @description A trial to run again and record: that with a `seed` of the trials that the job `trials` has run.
         */
        TrialReplayRequest: {
            /** @enum {unknown} */
            kind: "trial-replay";
            trials: string;
            seed: number;
        };
        /**
         * ReportRequest
         * @description An operation that has ended, to make a report of: without a `film` it takes a fraction of the time.
         */
        ReportRequest: {
            /** @enum {unknown} */
            kind: "report";
            operation: string;
            /** @default true */
            film?: boolean;
        };
        /**
         * LearnRequest
         * @description A task of a cell's library with arguments, from whose trials in the cell's scene parameters are learned.
         *
         *         `cell` may be left out if there is only one. The texts of the library stay as they are: `spec.apply` is refused.
         */
        LearnRequest: {
            /** @enum {unknown} */
            kind: "learn";
            /** @default null */
            cell?: string | null;
            task: string;
            /** @default {} */
            arguments?: {
                [key: string]: string;
            };
            spec: components["schemas"]["LearnSpec"];
        };
        /**
         * LearnSpec
         * @description What is minimised under which constraints, the parameters, how much is tried, and what the result is used for.
         */
        LearnSpec: {
            /**
             * @description The objectives: figures of trials or expressions over them, between commas.
             * @default null
             */
            minimise?: string | null;
            /**
             * @description What every trial has to meet, besides its success: comparisons of figures, between commas, such as `coverage == 100 %, impact <= 2`.
             * @default null
             */
            subject_to?: string | null;
            /**
             * @description The parameters that are learned, between commas; by default all with a range, in the library of the task, whose defaults the task uses.
             * @default null
             */
            parameters?: string | null;
            /**
             * @description How many candidates are tried, the defaults included.
             * @default 50
             */
            candidates?: number;
            /**
             * @description The trials of a candidate, each in another world, the same ones for all.
             * @default 5
             */
            trials?: number;
            /**
             * @description Further worlds, in which the best candidate is compared with the defaults.
             * @default 10
             */
            fresh?: number;
            /**
             * @description The seed of the first world.
             * @default 0
             */
            seed?: number;
            /**
             * @description How candidates are chosen: by tree-structured Parzen estimators, NSGA-II, Gaussian processes (needs torch and scipy), or at random.
             * @default tpe
             * @enum {unknown}
             */
            sampler?: "gp" | "nsga2" | "random" | "tpe";
            /**
             * @description How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`.
             * @default null
             */
            reality?: string | null;
            /**
             * @description Propose this candidate of the front, instead of the one that is chosen.
             * @default null
             */
            take?: number | null;
            /**
             * @description Write the learned values into the files of the library.
             * @default false
             */
            apply?: boolean;
            /**
             * @description The time limit of one trial, in wall time.
             * @default 3600
             */
            deadline_s?: number;
        };
        /**
         * ProblemDetails
         * @description Why a request was refused; nothing has changed. `detail` says what to do.
         *
         *         `type` is `about:blank`, and `title` the phrase of the status, unless there is more to know than the status.
         *         `allowed` are the commands that the state of an operation allows. `diagnostics` are the errors of a goal, a call or
         *         an argument, as of `skillc check --json`, and `texts` what they point into, by path; long texts are left out.
         */
        ProblemDetails: {
            /** @default about:blank */
            type?: string;
            title: string;
            status: number;
            detail: string;
            /** @default null */
            allowed?: string[] | null;
            /** @default null */
            diagnostics?: components["schemas"]["DiagnosticData"][] | null;
            /** @default null */
            texts?: {
                [key: string]: string;
            } | null;
        };
        /**
         * DiagnosticData
         * @description A problem: its name, as `skillc explain` knows it, where it is, and what to do about it.
         */
        DiagnosticData: {
            column: number;
            end_column: number;
            end_line: number;
            fix: components["schemas"]["FixData"] | null;
            help: string;
            labels: components["schemas"]["LabelData"][];
            line: number;
            message: string;
            name: string;
            path: string;
            /** @enum {unknown} */
            severity: "error" | "note" | "warning";
        };
        /**
         * FixData
         * @description An edit that removes the problem: `text` replaces the range; one that is not `safe` may change a meaning.
         */
        FixData: {
            column: number;
            end_column: number;
            end_line: number;
            line: number;
            message: string;
            path: string;
            safe: boolean;
            text: string;
        };
        /**
         * LabelData
         * @description Another place that a diagnostic is about.
         */
        LabelData: {
            column: number;
            end_column: number;
            end_line: number;
            line: number;
            message: string;
            path: string;
        };
        /**
         * JobResult
         * @description The result of the job with an id.
         */
        JobResult: {
            job: string;
            outcome: components["schemas"]["PlanResult"] | components["schemas"]["RunResult"] | components["schemas"]["TrialsResult"] | components["schemas"]["LearnResult"];
        };
        /**
         * PlanResult
         * @description The result of a plan.
         */
        PlanResult: {
            /** @enum {unknown} */
            kind: "plan";
            plan: components["schemas"]["PlanPreview"];
        };
        /**
         * PlanPreview
         * @description The answer of the planners for the world after the write `sequence`; as `skillc plan` prints it in `text`.
         *
         *         `failure` and `causes` say why there is no plan. `minimise` is what a plan has little of, `optimal` what is proved
         *         of that, `at_least_s` its lower bound. `duration_s` is the work, `makespan_s` the time until the last step ends.
         *         `space` is what is known of the plan in space, None if nobody has looked. A policy goes on with one of its
         *         `branches`, and takes `worst_s` if always the longest comes.
         */
        PlanPreview: {
            /** @enum {unknown} */
            status: "gave-up" | "solved" | "unsolvable";
            sequence: number;
            text: string;
            /**
             * @default work
             * @enum {unknown}
             */
            minimise?: "cost" | "makespan" | "work";
            /** @default [] */
            plan?: components["schemas"]["PreviewedStep"][];
            /** @default false */
            plan_optimal?: boolean;
            /** @default  */
            optimal?: string;
            /** @default null */
            at_least_s?: number | null;
            /** @default  */
            quality?: string;
            /** @default [] */
            assumptions?: string[];
            /** @default [] */
            left_out?: components["schemas"]["OmittedPart"][];
            /** @default null */
            duration_s?: number | null;
            /** @default null */
            cost?: number | null;
            /** @default null */
            makespan_s?: number | null;
            /** @default  */
            planner?: string;
            /** @default null */
            times?: string | null;
            /** @default null */
            note?: string | null;
            /** @default  */
            failure?: string;
            /** @default [] */
            causes?: string[];
            /** @default null */
            searched?: boolean | null;
            /** @default null */
            space?: components["schemas"]["SpaceClaim"] | null;
            /** @default [] */
            branches?: components["schemas"]["PreviewedBranch"][];
            /** @default null */
            worst_s?: number | null;
        };
        /**
         * PreviewedStep
         * @description A step of a plan: its skill, its arguments in short names, where the skill is defined, and when it runs, in s.
         *
         *         The times are those of a schedule; without one they are None.
         */
        PreviewedStep: {
            skill: string;
            arguments: {
                [key: string]: string;
            };
            source: string;
            /** @default null */
            start_s?: number | null;
            /** @default null */
            duration_s?: number | null;
        };
        /**
         * OmittedPart
         * @description Things without which a plan was made, and why; `harmless` if that is proved to make no difference.
         */
        OmittedPart: {
            kind: string;
            what: string[];
            why: string;
            harmless: boolean;
        };
        /**
         * PreviewedBranch
         * @description How a policy goes on after an outcome of its last step, and how likely that is, from 0 to 1.
         *
         *         `plan` is None if it is planned when the outcome comes. `duration_s` is the expected duration of the branch, in s.
         */
        PreviewedBranch: {
            outcome: string;
            likely: number;
            /** @default null */
            plan?: components["schemas"]["PreviewedStep"][] | null;
            /** @default null */
            duration_s?: number | null;
            /** @default [] */
            branches?: components["schemas"]["PreviewedBranch"][];
        };
        /**
         * RunResult
         * @description The result of what was run in simulation: a rehearsal, a trial again, an operation for its report.
         */
        RunResult: {
            /** @enum {unknown} */
            kind: "run";
            run: components["schemas"]["TaskResult"];
        };
        /**
         * TaskResult
         * @description The result of a task; one that did not start is `refused`, and `failure` is why it did not succeed.
         *
         *         `cause` is the same with all details, None if the task did not begin; `failed_calls` lead to it, outermost first.
         *
         *         `plan_optimal` is None if nothing was planned; `plan_quality` describes how good the plan is known to be, and for
         *         which problem, `plan_in_space` what is known of it in space, None if nobody has looked. `facts` are those that a
         *         success rests on; it is `verified` if none of them is only assumed, and no claim is false. `false_claims` are
         *         sentences about what the world model claims of things at the end that is not so in the simulator. `plan` has the
         *         steps that abandoned plans have started, then those of the last plan or of the body, in order of time;
         *         `planned_steps` is how many the last plan has, `replanned` why it replaced each other one, among them what was
         *         `sensed` that decided how a policy went on. `wipings` has one entry
         *         for each time a surface was wiped, `wiping` is the first of them; `placements` has one for each thing that was
         *         moved, `works` one for each other piece of work, `touches` one for each contact of a link, hand or base. What only
         *         a simulator knows is left out if the cell was not `simulated`; `sim_time_s` is the time of its clock. Arms and
         *         bases had the share `speed` of their speeds. After a `dry` run `commands` are what would have been sent; nothing
         *         was sent, all other results are of the simulation, and `verified` is None.
         */
        TaskResult: {
            task: string;
            status: ("failed" | "interrupted" | "stopped" | "succeeded") | "refused";
            /** @default null */
            verified?: boolean | null;
            /** @default [] */
            facts?: components["schemas"]["KnownFact"][];
            /** @default [] */
            false_claims?: string[];
            /** @default [] */
            plan?: components["schemas"]["StepResult"][];
            /** @default [] */
            choices?: components["schemas"]["ChoiceResult"][];
            /** @default 0 */
            planned_steps?: number;
            /** @default null */
            plan_optimal?: boolean | null;
            /** @default  */
            plan_quality?: string;
            /** @default null */
            plan_in_space?: components["schemas"]["SpaceClaim"] | null;
            /** @default  */
            planner?: string;
            /** @default [] */
            robots?: components["schemas"]["LabelledIri"][];
            /** @default [] */
            controllers?: string[];
            /** @default 0 */
            sim_time_s?: number;
            /** @default 0 */
            wall_time_s?: number;
            /** @default 0 */
            real_time_factor?: number;
            /** @default 1 */
            speed?: number;
            /** @default false */
            dry?: boolean;
            /** @default [] */
            commands?: components["schemas"]["CommandsResult"][];
            /** @default 0 */
            seed?: number;
            /** @default  */
            variation?: string;
            /** @default true */
            simulated?: boolean;
            /** @default null */
            wiping?: components["schemas"]["WipingResult"] | null;
            /** @default [] */
            wipings?: components["schemas"]["WipingResult"][];
            /** @default [] */
            placements?: components["schemas"]["PlacementResult"][];
            /** @default [] */
            works?: (components["schemas"]["PushResult"] | components["schemas"]["SearchResult"] | components["schemas"]["GuidanceResult"] | components["schemas"]["GraspResult"] | components["schemas"]["DriveResult"])[];
            /** @default [] */
            touches?: components["schemas"]["TouchResult"][];
            /** @default [] */
            replanned?: string[];
            /** @default [] */
            sensed?: string[];
            /** @default null */
            failure?: string | null;
            /** @default null */
            cause?: components["schemas"]["Failure"] | null;
            /** @default [] */
            failed_calls?: components["schemas"]["FailedCall"][];
        };
        /**
         * StepResult
         * @description One call that a plan or a given body made, or was to make, with its arguments by parameter name and its line.
         *
         *         `number` is that by which `skillc why` knows it; `rounds` are those of the loops around it, the outermost first.
         *         `implementation` is empty if it never started, and `fixed` if the call names it; `alternatives` is the number of
         *         others that it could have been, of which `rejected` could not be used. Times in s; `failure` is why it did not
         *         succeed.
         */
        StepResult: {
            skill: string;
            implementation: string;
            arguments: {
                [key: string]: boolean | number | string | (components["schemas"]["LabelledIri"] | components["schemas"]["LabelledQuantity"] | components["schemas"]["NotFinite"] | components["schemas"]["LabelledVector"] | components["schemas"]["LabelledPose"] | components["schemas"]["ValueList"]);
            };
            source: string;
            status: string;
            /** @default  */
            number?: string;
            /** @default [] */
            rounds?: components["schemas"]["LoopRound"][];
            /** @default null */
            start_s?: number | null;
            /** @default null */
            end_s?: number | null;
            /** @default null */
            failure?: string | null;
            /** @default false */
            fixed?: boolean;
            /** @default 0 */
            alternatives?: number;
            /** @default [] */
            rejected?: components["schemas"]["Rejection"][];
        };
        /**
         * LoopRound
         * @description The round of a loop in which a call was made, from 1; `loop` is its node, for example `retry 3`.
         */
        LoopRound: {
            loop: string;
            number: number;
        };
        /**
         * ChoiceResult
         * @description The implementation that was chosen among several for a skill, and those that were rejected.
         */
        ChoiceResult: {
            skill: string;
            implementation: string;
            /** @default [] */
            rejected?: components["schemas"]["Rejection"][];
        };
        /**
         * CommandsResult
         * @description What an arm would have been sent in a dry run: `count` commands, of which the limits have altered some.
         *
         *         `greatest_share` is that of a joint's limit of torque, or of speed, which `joint` was commanded.
         */
        CommandsResult: {
            arm: string;
            /** @enum {unknown} */
            kind: "position" | "torque" | "velocity";
            count: number;
            altered: number;
            joint: string;
            greatest_share: number;
        };
        /**
         * WipingResult
         * @description The quality of one wiping of a surface, measured by the simulator and not by the controller.
         *
         *         `start_s` and `end_s` are those of its path, in s.
         *
         *         `lane_dwell_s` is the time lost at each corner of the lanes, None without corners; if an overlay hides the dwell of
         *         the tool, it is the dwell of the commanded path.
         */
        WipingResult: {
            surface: components["schemas"]["LabelledIri"];
            start_s: number;
            end_s: number;
            coverage: number;
            force_command_n: number;
            force_mean_n: number;
            force_rmse_n: number;
            contact_lost: number;
            vibration_mm_s: number;
            tilt_rms_deg: number;
            first_impact_n: number;
            tracking_rms_mm: number;
            /** @default null */
            lane_dwell_s?: number | null;
            /**
             * @default tool
             * @enum {unknown}
             */
            lane_dwell_of?: "path" | "tool";
        };
        /**
         * PlacementResult
         * @description Where a thing that the run moved is at its end, in m in the world: believed, and as the simulator has it.
         *
         *         `holder` is what is believed to contain it, None for nothing; it is held if that is a gripper. `holder_known` and
         *         `known` are the evidence for that and for the believed place. `error_m` and `turned_deg` are how far the true pose
         *         is from the believed one. `intended_m` is where (x, y) its middle should be, to which it was last carried, and
         *         `missed_m` how far from there it really is in the plane. What is not known is None: a held thing is believed to be
         *         where the hand is. `moved_with` is what carried it along after it was put there, whose place `known` is about.
         */
        PlacementResult: {
            thing: components["schemas"]["LabelledIri"];
            holder: components["schemas"]["LabelledIri"] | null;
            is_held: boolean;
            holder_known: string;
            known: string;
            believed_m: [
                number,
                number,
                number
            ] | null;
            true_m: [
                number,
                number,
                number
            ] | null;
            error_m: number | null;
            turned_deg: number | null;
            /** @default null */
            intended_m?: [
                number,
                number
            ] | null;
            /** @default null */
            missed_m?: number | null;
            /** @default null */
            moved_with?: components["schemas"]["LabelledIri"] | null;
        };
        /**
         * PushResult
         * @description A tool was pressed on something: times in s, forces in N opposite to the push, travel in mm after contact.
         *
         *         `skill` is the innermost skill around the push, `on` what its parameters name besides devices. The mean and the
         *         greatest force are those that the arm knew, from `force_source`, while there was contact; `true_` ones are those of
         *         the simulator, None where it has none. `contact_s` is when something was touched, by the simulator if it has the
         *         force, None if nothing was.
         */
        PushResult: {
            /** @enum {unknown} */
            type: "push";
            skill: string;
            arm: components["schemas"]["LabelledIri"];
            on: components["schemas"]["LabelledIri"][];
            start_s: number;
            end_s: number;
            contact_s: number | null;
            force_command_n: number;
            force_mean_n: number | null;
            force_greatest_n: number | null;
            /** @enum {unknown} */
            force_source: "estimate" | "sensor";
            true_mean_n: number | null;
            true_greatest_n: number | null;
            travel_mm: number | null;
        };
        /**
         * SearchResult
         * @description Something was searched for with a pressed tool, as the arm measured it: times in s, lengths in mm.
         *
         *         `path_mm` is how far the tool went across the push, `radius_mm` how far from where the search began it came,
         *         `found_mm` how far from there it was when something gave way, None if nothing did. `depth_mm` is how far it then
         *         sank below where it had searched, to the end of the push.
         */
        SearchResult: {
            /** @enum {unknown} */
            type: "search";
            skill: string;
            arm: components["schemas"]["LabelledIri"];
            on: components["schemas"]["LabelledIri"][];
            start_s: number;
            end_s: number;
            path_mm: number;
            radius_mm: number;
            found_mm: number | null;
            depth_mm: number;
        };
        /**
         * GuidanceResult
         * @description An arm yielded in all directions, so that it could be guided: times in s, lengths in mm, speed in mm/s.
         *
         *         The forces in N of whoever guided it are those of the simulator; None if nobody did.
         */
        GuidanceResult: {
            /** @enum {unknown} */
            type: "guidance";
            arm: components["schemas"]["LabelledIri"];
            start_s: number;
            end_s: number;
            path_mm: number;
            moved_mm: number;
            greatest_speed_mm_s: number;
            person_mean_n: number | null;
            person_greatest_n: number | null;
        };
        /**
         * GraspResult
         * @description A thing was grasped by a gripper: times in s, None if it was held to the end, and the grip 0.2 s after the grasp.
         *
         *         force_n: with which each finger presses, by the simulator, None where it computes none; opening_mm: by the sensor of
         *         the fingers.
         */
        GraspResult: {
            /** @enum {unknown} */
            type: "grasp";
            thing: components["schemas"]["LabelledIri"];
            gripper: components["schemas"]["LabelledIri"];
            grasped_s: number;
            released_s: number | null;
            force_n: number | null;
            opening_mm: number | null;
        };
        /**
         * DriveResult
         * @description A mobile base drove during the run: the length of its path in m, by the simulator.
         */
        DriveResult: {
            /** @enum {unknown} */
            type: "drive";
            robot: components["schemas"]["LabelledIri"];
            path_m: number;
        };
        /**
         * TouchResult
         * @description What a part of a robot touched that it should not, as the simulator saw it, as texts.
         *
         *         Times in s, the greatest force in N, None where the simulation does not compute it.
         */
        TouchResult: {
            part: string;
            other: string;
            start_s: number;
            end_s: number;
            /** @default null */
            peak_force_n?: number | null;
        };
        /**
         * FailedCall
         * @description A call that failed, with its implementation, and its source line.
         */
        FailedCall: {
            name: string;
            source: components["schemas"]["Position"];
        };
        /**
         * TrialsResult
         * @description The result of trials: those that are done, judged.
         */
        TrialsResult: {
            /** @enum {unknown} */
            kind: "trials";
            series: components["schemas"]["Series"];
        };
        /**
         * Series
         * @description All trials of one task: `wanted` were requested, `done` were run, and `passed` of these met all criteria.
         *
         *         `pass_interval` is the confidence interval of the probability to pass, from the trials that were done; None if none
         *         was. In `unverified` trials the task finished, but the facts `assumed` were not sensed. `false_successes` are trials
         *         that succeeded although the world model claims something false about things. `mean_wall_time_s` is the mean of
         *         the wall times of those trials that were run now, None if none was.
         */
        Series: {
            task: string;
            /** @enum {unknown} */
            disturbance: "missing" | "none" | "obstacle" | "push" | "take";
            wanted: number;
            done: number;
            passed: number;
            pass_interval: components["schemas"]["Interval"] | null;
            spreads: components["schemas"]["Spread"][];
            failed: components["schemas"]["FailedSeed"][];
            trials: components["schemas"]["Trial"][];
            /** @default 0 */
            unverified?: number;
            /** @default [] */
            assumed?: string[];
            /** @default 0 */
            false_successes?: number;
            /** @default null */
            mean_wall_time_s?: number | null;
        };
        /**
         * Interval
         * @description The ends of a confidence interval at the level LEVEL.
         */
        Interval: {
            low: number;
            high: number;
        };
        /**
         * Spread
         * @description A metric of one object over all trials in which it was measured; `met` is the number that meet the target.
         *
         *         `low_quartile` and `high_quartile` enclose the middle half of the values; `mean_interval` is the confidence
         *         interval of the `mean`, None for a single value. `target` is the target as text, `bound` its value, None without a
         *         target; small values are the better ones if `sense` is `at most`. `values` are in the order of `seeds`, those of the
         *         trials in which they were measured.
         */
        Spread: {
            metric: string;
            subject: string;
            unit: string;
            target: string;
            bound: number | null;
            least: number;
            median: number;
            greatest: number;
            low_quartile: number;
            high_quartile: number;
            mean: number;
            mean_interval: components["schemas"]["Interval"] | null;
            met: number;
            values: number[];
            /** @default [] */
            seeds?: number[];
            /**
             * @default at-most
             * @enum {unknown}
             */
            sense?: "at-least" | "at-most";
            /** @default null */
            median_missed?: string | null;
        };
        /**
         * FailedSeed
         * @description A seed whose trial failed, with the reasons and how reality differed from the world model.
         */
        FailedSeed: {
            seed: number;
            reasons: string[];
            variation: string;
        };
        /**
         * Trial
         * @description One run: its seed, how it ended and why, how reality differed from the world model, and what was measured.
         *
         *         `assumed` are the facts that a success rests on and that were not sensed; it is `verified` if there are none.
         *         `works` has an entry for each object that was worked on; `coverage` is the lowest of all surfaces, wiped or not,
         *         over the whole run, None without surfaces. `greatest_force_n` is the greatest contact force on any tool, None
         *         without tools, `force_limit_n` the lowest limit of the arms, None if no arm has one. `pushed` is whether a person
         *         pushed the arm, `taken` whether they took what a hand held, `at_rest` whether at the end nothing moved and no force
         *         was applied. `false_claims` are sentences about what the world model claims at the end of things and where they are,
         *         and what really is so.
         */
        Trial: {
            seed: number;
            status: ("failed" | "interrupted" | "stopped" | "succeeded") | ("crashed" | "refused");
            /** @default null */
            reason?: string | null;
            /** @default null */
            verified?: boolean | null;
            /** @default [] */
            assumed?: string[];
            /** @default  */
            variation?: string;
            /** @default [] */
            false_claims?: string[];
            /** @default [] */
            works?: (components["schemas"]["WipingWork"] | components["schemas"]["PolishingWork"] | components["schemas"]["PressingWork"] | components["schemas"]["InsertingWork"] | components["schemas"]["TeachingWork"] | components["schemas"]["PlacingWork"])[];
            /** @default null */
            coverage?: number | null;
            /** @default null */
            greatest_force_n?: number | null;
            /** @default null */
            force_limit_n?: number | null;
            /** @default false */
            pushed?: boolean;
            /** @default false */
            taken?: boolean;
            /** @default false */
            at_rest?: boolean;
            /** @default 0 */
            sim_time_s?: number;
        };
        /**
         * WipingWork
         * @description A surface was wiped.
         */
        WipingWork: {
            /** @enum {unknown} */
            type: "wiping";
            wiping: components["schemas"]["WipingResult"];
        };
        /**
         * PolishingWork
         * @description A surface was polished: wiped with an oscillating overlay, whose measured and commanded amplitudes are in m.
         *
         *         The amplitudes are None without an overlay. `polished_share` of the surface was rubbed for the required time.
         */
        PolishingWork: {
            /** @enum {unknown} */
            type: "polishing";
            wiping: components["schemas"]["WipingResult"];
            polished_share: number;
            overlay_amplitude_m: number | null;
            commanded_amplitude_m: number | null;
        };
        /**
         * PressingWork
         * @description A button was pressed: forces in N that it requires, that held it after it had switched, and the greatest one.
         *
         *         `duration_share` is the time of the work relative to the duration of the skill; None if the skill declares none.
         */
        PressingWork: {
            /** @enum {unknown} */
            type: "pressing";
            button: components["schemas"]["LabelledIri"];
            required_n: number;
            held_n: number;
            greatest_n: number;
            duration_share: number | null;
        };
        /**
         * InsertingWork
         * @description A peg is in a socket: its depth and the depth of the hole in m, the greatest force on it in N.
         */
        InsertingWork: {
            /** @enum {unknown} */
            type: "inserting";
            socket: components["schemas"]["LabelledIri"];
            depth_m: number;
            hole_depth_m: number;
            greatest_n: number;
            duration_share: number | null;
        };
        /**
         * TeachingWork
         * @description A pose was taught: its distance in m from the intended one, the greatest and mean force of the person in N.
         */
        TeachingWork: {
            /** @enum {unknown} */
            type: "teaching";
            pose: components["schemas"]["LabelledIri"];
            position_error_m: number;
            greatest_n: number;
            mean_n: number;
            duration_share: number | null;
        };
        /**
         * PlacingWork
         * @description A thing was put down: how far it is from its believed pose, in m and degrees, and from the intended place, in m.
         *
         *         `missed_m` is None if no place was intended.
         */
        PlacingWork: {
            /** @enum {unknown} */
            type: "placing";
            thing: components["schemas"]["LabelledIri"];
            error_m: number;
            turned_deg: number;
            missed_m: number | null;
        };
        /**
         * LearnResult
         * @description The result of learning: the proposed `values` by parameter, `Skill.implementation.name`, as they are written.
         *
         *         They are empty if nothing is better than the defaults. `objectives` are means over fresh seeds with the defaults and
         *         with the values, by the texts of the objectives. `confirmed` is whether no fewer fresh trials meet all constraints
         *         with the values than with the defaults. `diff` is the change of the texts.
         */
        LearnResult: {
            /** @enum {unknown} */
            kind: "learn";
            task: string;
            candidates: number;
            values: {
                [key: string]: string;
            };
            objectives: {
                [key: string]: [
                    number,
                    number
                ];
            };
            confirmed: boolean;
            diff: string;
        };
        /**
         * JobEvent
         * @description A line of the log of a job: its state and how much was done at a time, in ns since 1970, and what happened.
         *
         *         `sequence` counts from 1.
         */
        JobEvent: {
            sequence: number;
            wall_time_ns: number;
            /** @enum {unknown} */
            state: "cancelled" | "ended" | "failed" | "interrupted" | "running" | "waiting";
            done: number;
            message: string;
        };
        /**
         * LoginCode
         * @description A code that a request may have in the place of a token, once, within 60 s.
         */
        LoginCode: {
            code: string;
        };
        /**
         * SessionInfo
         * @description Who makes a request: the name of its token, and what it may do.
         */
        SessionInfo: {
            name: string;
            /** @enum {unknown} */
            role: "admin" | "edit" | "operate" | "view";
        };
        /**
         * SourceInfo
         * @description A text of a library, by the path that places in events and diagnostics have; `editable` if it is its own.
         */
        SourceInfo: {
            path: string;
            editable: boolean;
        };
        /**
         * SourceText
         * @description A text; `hash` is that of the file, by which a change says what it is based on.
         */
        SourceText: {
            path: string;
            editable: boolean;
            hash: string;
            text: string;
        };
        /**
         * SourceChange
         * @description A new text, in the place of the one whose file has the hash `base_hash`.
         */
        SourceChange: {
            text: string;
            base_hash: string;
        };
        /**
         * TokenInfo
         * @description A token as it is listed, without its secret; `created_ns` is in ns since 1970-01-01 UTC.
         */
        TokenInfo: {
            name: string;
            /** @enum {unknown} */
            role: "admin" | "edit" | "operate" | "view";
            created_ns: number;
            /** @default false */
            agent?: boolean;
        };
        /**
         * MadeToken
         * @description A token that was made; `token` is shown this once.
         */
        MadeToken: {
            name: string;
            /** @enum {unknown} */
            role: "admin" | "edit" | "operate" | "view";
            token: string;
        };
        /**
         * NewToken
         * @description A token to be made. What an `agent` asks for waits for the approval of somebody else.
         */
        NewToken: {
            name: string;
            /** @enum {unknown} */
            role: "admin" | "edit" | "operate" | "view";
            /** @default false */
            agent?: boolean;
        };
        /**
         * AuditEntry
         * @description A request that changed something, or that was refused; `wall_ns` is in ns since 1970-01-01 UTC.
         *
         *         `status` is that of the answer; 0 while it is carried out, and if it was when the server ended or its disk was full.
         */
        AuditEntry: {
            number: number;
            wall_ns: number;
            who: string;
            origin: string;
            action: string;
            status: number;
            detail: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export type operations = Record<string, never>;
