interface PickProps<Value extends string> {
  readonly label: string;
  readonly value: Value;
  readonly options: readonly (readonly [value: Value, text: string])[];
  readonly disabled?: boolean;
  readonly onPick: (value: Value) => void;
}

/** One of some, in the list that the device has for that. */
export function Pick<Value extends string>({ label, value, options, disabled = false, onPick }: PickProps<Value>) {
  return (
    <select
      class="pick"
      aria-label={label}
      value={value}
      disabled={disabled}
      onChange={({ currentTarget }) => {
        const picked = options.find(([one]) => one === currentTarget.value);
        // What is picked and not done is not shown either.
        currentTarget.value = value;
        if (picked) {
          onPick(picked[0]);
        }
      }}
    >
      {options.map(([one, text]) => (
        <option value={one} key={one}>
          {text}
        </option>
      ))}
    </select>
  );
}
