import type { OperationKind, Problem } from "../../../wire/generated";
import { ask, RequestFailed } from "../../requests/request";
import type { Order } from "./order";

/** Trees that are grown on request, and how far they are (`JB2`). */
export interface Job {
  readonly id: string;
  readonly state: "waiting" | "growing" | "done" | "failed";
  /** Jobs that come first. */
  readonly ahead: number;
  /** Seeds that have their file or their problem. */
  readonly done: number;
  readonly all: number;
  readonly growing?: { readonly seed: number; readonly metamers: number; readonly bytes: number };
  readonly results: readonly GrownTree[];
  readonly failed: readonly { readonly seed: number; readonly problem: Problem }[];
  /** Why it ended before it was done. */
  readonly problem?: Problem;
  /** What its trees are without (`JB10`). */
  readonly notes?: readonly JobNote[];
}

export interface JobNote {
  readonly note: "by-hand-left-out" | "wood-left-out";
  readonly operations?: readonly { readonly kind: OperationKind; readonly count: number }[];
}

export interface GrownTree {
  readonly seed: number;
  readonly metamers: number;
  readonly bytes: number;
  /** Where the file is. */
  readonly address: string;
}

/** Begins a job, once for a key (`IK1`). */
export function orderTrees(order: Order, key: string): Promise<Job> {
  return ask<Job>("POST", "/api/v1/grow", order, { key });
}

/** How far a job is; null where there is none such any more. */
export async function findJob(id: string): Promise<Job | null> {
  return orNull(ask<Job>("GET", pathOf(id)));
}

/** Ends a job, and its files go. */
export async function giveUpJob(id: string): Promise<void> {
  await orNull(ask<undefined>("DELETE", pathOf(id)));
}

/** All one's jobs, the newest first (`JB8`), each with its files. */
export async function listJobs(): Promise<readonly Job[]> {
  const ids: string[] = [];
  let before: number | undefined;
  do {
    const page = before === undefined ? "" : `?before=${before}`;
    const { jobs, next } = await ask<{ jobs: { id: string }[]; next?: number }>("GET", `/api/v1/jobs${page}`);
    ids.push(...jobs.map(({ id }) => id));
    before = next;
  } while (before !== undefined);
  // Some may have gone meanwhile.
  const found = await Promise.all(ids.map(findJob));
  return found.filter((job) => job !== null);
}

async function orNull<Answer>(answer: Promise<Answer>): Promise<Answer | null> {
  try {
    return await answer;
  } catch (error) {
    if (error instanceof RequestFailed && error.status === 404) {
      return null;
    }
    throw error;
  }
}

/** Where all files of a job are in one (`JB9`). */
export function archiveOf(id: string): string {
  return `${pathOf(id)}/results.zip`;
}

function pathOf(id: string): string {
  return `/api/v1/jobs/${encodeURIComponent(id)}`;
}
