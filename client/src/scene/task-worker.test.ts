import { expect, it } from "vitest";
import { TaskWorker, type WorkerPort } from "./task-worker";

type Port = WorkerPort<number, string>;

function setUp(start?: () => Port) {
  const heard: string[] = [];
  const ports: (Port & { readonly tasks: number[]; ended: boolean })[] = [];
  const make = () => {
    const tasks: number[] = [];
    const port = {
      onmessage: null as Port["onmessage"],
      onerror: null as Port["onerror"],
      tasks,
      ended: false,
      postMessage: (task: number) => void tasks.push(task),
      terminate: () => {
        port.ended = true;
      },
    };
    ports.push(port);
    return port;
  };
  const worker = new TaskWorker<number, string>(
    start ?? make,
    (answer) => heard.push(answer),
    () => heard.push("failed"),
  );
  return { worker, ports, heard };
}

it("a worker is started with its first task, and hears of all others", () => {
  const { worker, ports, heard } = setUp();
  expect(ports.length).toBe(0);
  expect([worker.send(1), worker.send(2)]).toEqual([true, true]);
  expect(ports.map(({ tasks }) => tasks)).toEqual([[1, 2]]);
  ports[0]!.onmessage!({ data: "one" });
  expect(heard).toEqual(["one"]);
});

it("one that was ended is followed by another one", () => {
  const { worker, ports } = setUp();
  worker.send(1);
  worker.end();
  expect(ports[0]!.ended).toBe(true);
  expect(worker.send(2)).toBe(true);
  expect(ports.map(({ tasks }) => tasks)).toEqual([[1], [2]]);
});

it("one that ends by itself is told of once, and followed by none", () => {
  const { worker, ports, heard } = setUp();
  worker.send(1);
  ports[0]!.onerror!();
  expect([heard, ports[0]!.ended]).toEqual([["failed"], true]);
  expect([worker.send(2), ports.length]).toEqual([false, 1]);
});

it("none is asked for again where none is to be had", () => {
  let asked = 0;
  const { worker, heard } = setUp(() => {
    asked += 1;
    throw new Error("no workers here");
  });
  expect([worker.send(1), worker.send(2), asked]).toEqual([false, false, 1]);
  expect(heard).toEqual([]);
});
