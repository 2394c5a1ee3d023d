declare module "swagger-ui-dist/swagger-ui-es-bundle.js" {
  /** What of the library's options is used here; the rest stands in its documentation. */
  interface Options {
    readonly dom_id: string;
    readonly url: string;
    readonly deepLinking: boolean;
    readonly filter: boolean;
    readonly docExpansion: "list" | "full" | "none";
    readonly defaultModelsExpandDepth: number;
    readonly tryItOutEnabled: boolean;
    readonly displayRequestDuration: boolean;
    readonly validatorUrl: string | null;
  }

  /** Shows an OpenAPI description in an element, to be read and tried. */
  export default function SwaggerUI(options: Options): void;
}
