import { Icon } from "../icons";

export const ResetIcon = () => (
  <Icon>
    <path d="M5.2 9.5A7.2 7.2 0 1 1 4.8 13" />
    <path d="M4.6 4.8v4.9h4.9" />
  </Icon>
);
